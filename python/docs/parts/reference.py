"""Writes the reference of the package: of its stubs, and of the sources of its modules. Nothing is imported."""

import ast
import inspect
import re

from . import ROOT, write

PACKAGE = ROOT / "python" / "python" / "geograd"
MODULES = [
    "torch", "jax", "cuda", "arrow", "geoarrow", "shapely", "ray", "datafusion", "metric", "assignment", "suppression", "torchvision",
    "mmrotate", "supervision", "ultralytics",
]
#: Classes of the stubs, beside shapes and verbs, that a user meets.
OWN = ["Polygons", "Paths", "Rings", "Polylines", "Clouds", "Function", "Verb", "Program", "Reports", "Symbol", "Truth"]


#: Sources whose functions have their defaults, which stubs have not.
SOURCES = ["_check.py", "_function.py", "_camera.py", "_elementary.py"]
#: An argument in a docstring, `samples: how many`.
ARGUMENT = re.compile(r"^([a-z_]+(?:, [a-z_]+)*): ")


def parsed(name):
    return ast.parse((PACKAGE / name).read_text(encoding="utf-8"))


def listed(own):
    """Returns a line and the indented list below it as Markdown."""
    return f"{own[1]}:\n\n" + re.sub(r"(?m)^    ", "", own[2]) + "\n"


def markdown(text):
    """Returns a docstring as Markdown."""
    text = re.sub(r":(?:\w+):`([^`]*)`", r"`\1`", text or "")
    # Sessions stand in fences, and lists below a line of their own are no code.
    text = re.sub(r"(?m)^>>> .*\n(?:.+\n)*", lambda own: f"```pycon\n{own[0]}```\n", inspect.cleandoc(text) + "\n")
    text = re.sub(r"(?m)^(\S.*)\n((?:    .*\n)*    \* .*\n(?:    .*\n)*)", listed, text)
    lines, code = [], False
    for line in inspect.cleandoc(text).splitlines():
        inside = line.startswith("    ") or not line.strip()
        if code and not inside:
            lines += ["```", ""]
            code = False
        if not code and line.startswith("    ") and (not lines or not lines[-1].strip()):
            lines.append("```python")
            code = True
        if not code and ARGUMENT.match(line):
            lines += [""] if lines and lines[-1].strip() and not lines[-1].startswith(("* ", "  ")) else []
            line = ARGUMENT.sub(r"* `\1`: ", line)
        elif not code and line.strip() and not line.startswith("* ") and lines and lines[-1].startswith(("* `", "  ")):
            line = "  " + line
        if line.rstrip().endswith("::") and not code:
            line = line.rstrip()[:-2].rstrip() + (":" if line.strip() != "::" else "")
        lines.append(line[4:] if code and line.startswith("    ") else line)
    if code:
        lines.append("```")
    return re.sub(r"\n\n+(```\n)", r"\n\1", "\n".join(lines)).strip()


def signature(node, name=None, owner=False):
    """Returns a call: names, `*`, and the defaults that are not `...`."""
    own = node.args
    plain = [*own.posonlyargs, *own.args]
    defaults = [None] * (len(plain) - len(own.defaults)) + list(own.defaults)
    parts = [one(argument, default) for argument, default in zip(plain, defaults)][1 if owner else 0 :]
    if own.vararg:
        parts.append(f"*{own.vararg.arg}")
    elif own.kwonlyargs:
        parts.append("*")
    parts += [one(argument, default) for argument, default in zip(own.kwonlyargs, own.kw_defaults)]
    if own.kwarg:
        parts.append(f"**{own.kwarg.arg}")
    call = f"{name or node.name}({', '.join(parts)})"
    return call if len(call) <= 84 else f"{name or node.name}(\n    " + ",\n    ".join(parts) + ",\n)"


def one(argument, default):
    """Returns an argument with its default; `...` of a stub is left out, since the text says what it is."""
    if default is None:
        return argument.arg
    if isinstance(default, ast.Constant) and default.value is Ellipsis:
        return f"{argument.arg}=…"
    return f"{argument.arg}={ast.unparse(default)}"


def entry(title, call, text, level=2):
    head = f"{'#' * level} `{title}`\n\n"
    return head + (f"```python\n{call}\n```\n\n" if call else "") + f"{markdown(text)}\n"


def functions(body, names=None, owner=False):
    """Returns the functions of a body that are no overloads and no names of Python's."""
    found = {}
    for node in body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and node.name not in found:
            if names is None or node.name in names:
                found[node.name] = node
    return list(found.values())


def is_property(node):
    return any(ast.unparse(mark) == "property" for mark in node.decorator_list)


def shapes(classes):
    """Returns the page of shapes: a table of numbers each."""
    text = [
        "# Shapes",
        "",
        "A shape is an array whose last axis has the numbers of one, in the order of the table. Its attributes",
        "have the names of the fields: `boxes.center.x`, `boxes.heading`.",
        "",
    ]
    for node in classes:
        doc = inspect.cleandoc(ast.get_docstring(node)).splitlines()
        start = next(i for i, line in enumerate(doc) if line.startswith("An array whose last axis"))
        rows = [line.strip().split(": ", 1) for line in doc[start + 1 :] if line.strip()]
        text += [
            f"## `{node.name}`",
            "",
            *doc[:start],
            f"{len(rows)} numbers." if len(rows) > 1 else "One number.",
            "",
            "| place | name | meaning |",
            "| --- | --- | --- |",
        ]
        text += [f"| {place} | `{name}` | {meaning} |" for place, (name, meaning) in enumerate(rows)]
        text.append("")
    return "\n".join(text)


def verbs(classes, known):
    """Returns the page of verbs: a table of rows each."""
    text = [
        "# Verbs",
        "",
        "A verb is one name for a function of many shapes. Its shapes choose the row. Each verb has the forms on the",
        "page of [`geograd`](geograd.md), such as `value_grad` and `all_pairs`.",
        "",
    ]
    for node in classes:
        name = node.name[1:]
        lines = inspect.cleandoc(ast.get_docstring(node)).splitlines()
        summary = lines[0]
        text += [f"## `{name}`", "", summary, "", "| takes | gives | meaning |", "| --- | --- | --- |"]
        calls = []
        for line in lines[1:]:
            match = re.match(rf"    {name}\((.*)\) -> (.*)", line)
            if match:
                calls.append([*match.groups(), summary])
            elif line.startswith("        ") and calls:
                calls[-1][2] = line.strip()
        for takes, gives, special in calls:
            linked = [named(part, known) for part in takes.split(", ")]
            text.append(
                f"| {', '.join(linked)} | {', '.join(named(part, known) for part in gives.split(', '))} | {special} |"
            )
        text.append("")
    return "\n".join(text)


def named(part, known):
    """Returns `a: Obb2` with a link to the shape."""
    name, _, kind = part.rpartition(": ")
    kind = f"[`{kind}`](shapes.md#{kind.lower()})" if kind in known else f"`{kind}`"
    return f"{name} {kind}".strip()


def package(tree, classes):
    """Returns the page of functions, forms and classes of the package."""
    text = [
        "# `geograd`",
        "",
        "The package itself: own functions, checks, threads, and the forms of every verb and function.",
        "[Verbs](verbs.md) and [shapes](shapes.md) have pages of their own.",
        "",
        "## Functions",
        "",
    ]
    whole = {node.name: node for name in SOURCES for node in functions(parsed(name).body)}
    for node in functions(tree.body):
        node = whole.get(node.name, node)
        text.append(entry(f"geograd.{node.name}", signature(node), ast.get_docstring(node), 3))
    text += ["## Polygons and points", "", "Objects that are called, some with a `vjp` or further forms.", ""]
    for name, own, doc in objects(tree):
        call = next(node for node in own.body if isinstance(node, ast.FunctionDef) and node.name == "__call__")
        text.append(entry(f"geograd.{name}", signature(call, name, owner=True), doc, 3))
    forms = next(node for node in parsed("_forms.py").body if isinstance(node, ast.ClassDef))
    text += [
        "## Forms",
        "",
        "Of every verb, `geograd.iou.value_grad(a, b)`, and of every function that is recorded.",
        "",
    ]
    text += [
        entry(node.name, signature(node, owner=True), ast.get_docstring(node), 3) for node in functions(forms.body)
    ]
    text += ["## Classes", ""]
    for node in sorted((node for node in classes if node.name in OWN), key=lambda node: OWN.index(node.name)):
        text.append(entry(f"geograd.{node.name}", None, ast.get_docstring(node), 3))
        for own in functions(node.body):
            call = own.name if is_property(own) else signature(own, owner=True)
            text.append(
                f"* `{' '.join(call.split())}`: {said(own)}" if said(own) else f"* `{' '.join(call.split())}`"
            )
        text.append("")
    return "\n".join(text)


def objects(tree):
    """Returns the objects of the stubs that are no verbs and are called: name, class, text."""
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    for node, after in zip(tree.body, tree.body[1:]):
        own = classes.get(ast.unparse(node.annotation)) if isinstance(node, ast.AnnAssign) else None
        if own is not None and not own.bases and isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant):
            yield ast.unparse(node.target), own, after.value.value


def said(node):
    """Returns the first line of a function's documentation."""
    return (ast.get_docstring(node) or "").partition("\n")[0]


def module(name):
    """Returns the page of a module: what it says of itself, its functions and classes."""
    tree = parsed(f"{name}.py")
    text = [f"# `geograd.{name}`", "", markdown(ast.get_docstring(tree)), ""]
    if name == "torch":
        found = [f"`{loss}` of [`{verb}`](verbs.md#{verb})" for loss, verb in losses().items()]
        text += [f"Losses by the names of their scores: {', '.join(found)}.", ""]
    for node in [*imported(tree), *tree.body]:
        if (
            not isinstance(node, (ast.FunctionDef, ast.ClassDef))
            or node.name.startswith("_")
            or not ast.get_docstring(node)
        ):
            continue
        if isinstance(node, ast.FunctionDef):
            text.append(entry(f"geograd.{name}.{node.name}", signature(node), ast.get_docstring(node)))
            continue
        made = constructor(node)
        text.append(
            entry(
                f"geograd.{name}.{node.name}",
                made and signature(made, node.name, owner=True),
                ast.get_docstring(node),
            )
        )
        for own in methods(node):
            if ast.get_docstring(own):
                text.append(entry(f"{node.name}.{own.name}", signature(own, owner=True), ast.get_docstring(own), 3))
    return "\n".join(text)


def methods(node, source="_cuda_calls.py"):
    """Returns the methods of a class; those of verbs on a card are in the class that they extend."""
    yield from functions(node.body)
    bases = {ast.unparse(own) for own in node.bases}
    for base in parsed(source).body if node.name == "Verb" else []:
        if isinstance(base, ast.ClassDef) and base.name in bases:
            yield from functions(base.body)


def imported(tree):
    """Returns the functions and classes that a module has from the private ones: those that its `__all__` names."""
    public = [node.value for node in tree.body if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"]
    names = {own.value for value in public for own in ast.walk(value) if isinstance(own, ast.Constant)}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("geograd._"):
            wanted = {own.name for own in node.names} & names
            for own in parsed(f"{node.module.partition('.')[2]}.py").body:
                if isinstance(own, (ast.FunctionDef, ast.ClassDef)) and own.name in wanted:
                    yield own


def constructor(node, sources=("_torch_polygons.py", "_jax_columns.py", "_losses.py")):
    """Returns the constructor of a class, or of the class that it extends."""
    made = next((own for own in node.body if isinstance(own, ast.FunctionDef) and own.name == "__init__"), None)
    if made is not None or not node.bases:
        return made
    for source in sources:
        classes = {own.name: own for own in parsed(source).body if isinstance(own, ast.ClassDef)}
        if classes.get(node.name) is not None and ast.dump(classes[node.name]) == ast.dump(node):
            base = classes.get(ast.unparse(node.bases[0]))
            return base and constructor(base, [source])
    return None


def losses():
    """Returns the names of losses and of the verbs that score them."""
    for node in parsed("_nodes.py").body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "LOSSES":
            return ast.literal_eval(node.value)
    raise LookupError("_nodes.py has no LOSSES")


def make(pages):
    """Writes the pages of the reference."""
    tree = parsed("__init__.pyi")
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef)]
    of = {
        base: [node for node in classes if [ast.unparse(own) for own in node.bases] == [base]]
        for base in ("Shape", "Verb")
    }
    known = {node.name for node in of["Shape"]}
    folder = pages / "reference"
    write(folder / "shapes.md", shapes(of["Shape"]))
    write(folder / "verbs.md", verbs(of["Verb"], known))
    write(folder / "geograd.md", package(tree, classes))
    lines = [
        "# Reference",
        "",
        "Written from the stubs and the documentation of the package when this site is built.",
        "",
        f"* [Verbs](verbs.md): {len(of['Verb'])} names, from `alpha_iou` to `winding`",
        f"* [Shapes](shapes.md): {len(known)} kinds of boxes, bodies, lines and cameras, number by number",
        "* [`geograd`](geograd.md): own functions, checks, forms, threads",
    ]
    for name in MODULES:
        write(folder / f"{name}.md", module(name))
        lines.append(f"* [`geograd.{name}`]({name}.md): {ast.get_docstring(parsed(f'{name}.py')).splitlines()[0]}")
    lines += [
        "",
        "Rust: [the documentation of the crate](https://docs.rs/geograd) has the same verbs, with their mathematics.",
        "",
    ]
    write(folder / "index.md", "\n".join(lines))
