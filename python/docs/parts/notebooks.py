"""Executes the notebooks, and writes a page of each with its results."""

import base64
import os
import re

from . import DOCS, write

FOLDER = DOCS / "notebooks"
ORDER = ["rotated_detection", "own_function", "robot_clearance", "city", "data_set"]
#: Runs before the cells of a notebook: pictures are drawn as SVG.
BEFORE = "%matplotlib inline\nget_ipython().run_line_magic('config', \"InlineBackend.figure_formats = ['svg']\")"
COLOURS = re.compile(r"\x1b\[[0-9;]*m")


class Failed(Exception):
    """A cell of a notebook failed."""


def read(name):
    """Returns a notebook."""
    import jupytext

    return jupytext.read(FOLDER / f"{name}.py", fmt="py:percent")


def executed(name):
    """Returns a notebook with the results of its cells. It runs in the folder of this process, with its package."""
    import nbclient
    import nbformat

    notebook = read(name)
    notebook.cells.insert(0, nbformat.v4.new_code_cell(BEFORE))
    kernel = {"MATPLOTLIBRC": str(FOLDER / "matplotlibrc"), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    before = {key: os.environ.get(key) for key in kernel}
    os.environ.update(kernel)
    try:
        nbclient.NotebookClient(
            notebook,
            kernel_name="python3",
            timeout=600,
            startup_timeout=180,
            resources={"metadata": {"path": str(FOLDER)}},
            extra_arguments=["--IPKernelApp.log_level=ERROR"],
        ).execute()
    except nbclient.exceptions.CellExecutionError as error:
        raise Failed(f"{name}: {COLOURS.sub('', str(error))}") from None
    finally:
        for key, old in before.items():
            if old is None:
                os.environ.pop(key)
            else:
                os.environ[key] = old
    notebook.cells.pop(0)
    return notebook


def fence(text, language):
    return f"```{language}\n{text.rstrip()}\n```\n"


def page(notebook, name, pages):
    """Returns the page of an executed notebook; its pictures are written beside it."""
    parts, pictures = [], 0
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            parts.append(cell.source + "\n")
            continue
        parts.append(fence(cell.source, "python"))
        printed = ""
        for output in cell.outputs:
            data = output.get("data", {})
            if output.output_type == "stream":
                # Logs of other libraries are on the other stream.
                printed += output.text if output.name == "stdout" else ""
            elif "image/svg+xml" in data or "image/png" in data:
                pictures += 1
                kind = "svg" if "image/svg+xml" in data else "png"
                file = pages / "notebooks" / f"{name}_{pictures}.{kind}"
                file.parent.mkdir(parents=True, exist_ok=True)
                if kind == "svg":
                    file.write_text(data["image/svg+xml"], encoding="utf-8")
                else:
                    file.write_bytes(base64.b64decode(data["image/png"]))
                parts.append(
                    f'<div class="picture" markdown>\n![Picture {pictures} of this notebook]({file.name})\n</div>\n'
                )
            elif "text/plain" in data:
                printed += data["text/plain"] + "\n"
        if printed.strip():
            parts.append(f'<div class="output" markdown>\n\n{fence(COLOURS.sub("", printed), "text")}\n</div>\n')
    return "\n".join(parts)


def make(pages, run=True):
    """Writes the pages of all notebooks, and their list; without `run` the pages have no results."""
    import jupytext

    (pages / "notebooks").mkdir(parents=True, exist_ok=True)
    lines = [
        "# Notebooks",
        "",
        "Each is executed when this site is built: results and pictures are those of its code.",
        "",
    ]
    for name in ORDER:
        notebook = executed(name) if run else read(name)
        title, first = re.match(r"# (.*)\n\n(.*?)(?:\n\n|$)", notebook.cells[0].source, re.S).groups()
        text = page(notebook, name, pages)
        jupytext.write(read(name), pages / "notebooks" / f"{name}.ipynb", fmt="ipynb")
        write(
            pages / "notebooks" / f"{name}.md",
            f"---\nhide: [toc]\n---\n\n{text}\n---\n\n[The notebook]({name}.ipynb), without results.\n",
        )
        lines += [f"## [{title}]({name}.md)", "", first, ""]
    write(pages / "notebooks" / "index.md", "\n".join(lines))
