"""Builds the site: draws the gallery, executes the notebooks, writes the reference, runs the generator, checks the
links.

    python python/docs/build.py                  # into target/site
    python python/docs/build.py --out FOLDER --fast

It needs the package and what requirements.txt beside it names. `--fast` executes no notebook.
"""

import argparse
import logging
import pathlib
import re
import shutil
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from parts import DOCS, ROOT, collected, gallery, links, notebooks, reference, sides

LIVE = DOCS / "live"
#: Whether both registries have the packages: the page of installation has the commands of either state.
RELEASED = False
STATES = re.compile(r"<!-- if unreleased -->\n(.*?)<!-- if released -->\n(.*?)<!-- end -->\n", re.S)


def stated(text, released=RELEASED):
    """Returns a page with the parts of one state."""
    return STATES.sub(lambda match: match[2 if released else 1], text)


def sources(pages, run):
    """Writes all sources of pages into an empty folder, and returns the seconds that each part took."""
    shutil.rmtree(pages, ignore_errors=True)
    shutil.copytree(DOCS / "pages", pages)
    shutil.copy(DOCS / "site.css", pages / "site.css")
    parts = {
        "gallery": lambda: gallery.make(pages),
        "notebooks": lambda: notebooks.make(pages, run),
        "reference": lambda: reference.make(pages),
        "collected": lambda: collected.make(pages),
        "instead": lambda: sides.make(pages),
    }
    seconds = {}
    for name, make in parts.items():
        start = time.perf_counter()
        make()
        seconds[name] = time.perf_counter() - start
    for path in pages.rglob("*.md"):
        path.write_text(stated(path.read_text(encoding="utf-8")), encoding="utf-8")
    if (LIVE / "index.html").exists():
        shutil.copytree(LIVE, pages / "live", ignore=shutil.ignore_patterns("*.py", "*.md", "__pycache__"))
    else:
        # A page has its link to the live one in a paragraph with this mark.
        for path in pages.rglob("*.md"):
            text = path.read_text(encoding="utf-8")
            kept = [part for part in text.split("\n\n") if "live/index.html" not in part]
            path.write_text("\n\n".join(kept), encoding="utf-8")
    return seconds


def generated(pages, out):
    """Runs the generator in its strict mode."""
    from mkdocs.commands.build import build
    from mkdocs.config import load_config
    from mkdocs.exceptions import Abort

    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    config = load_config(str(DOCS / "mkdocs.yml"), docs_dir=str(pages), site_dir=str(out), strict=True)
    if (pages / "live" / "index.html").exists():
        config["nav"].insert(1, {"Live": "live/index.html"})
    config.plugins.on_startup(command="build", dirty=False)
    try:
        build(config)
    except Abort as error:
        raise SystemExit(str(error)) from None


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--out",
        type=pathlib.Path,
        default=ROOT / "target" / "site",
        help="the folder of the site (default target/site)",
    )
    parser.add_argument("--fast", action="store_true", help="execute no notebook")
    options = parser.parse_args(arguments)
    out = options.out.absolute()
    pages = out.with_name(out.name + "-pages")
    seconds = sources(pages, not options.fast)
    start = time.perf_counter()
    shutil.rmtree(out, ignore_errors=True)
    generated(pages, out)
    seconds["generator"] = time.perf_counter() - start
    wrong = links.broken(out)
    for page, link in wrong:
        print(f"{page}: {link} leads nowhere", file=sys.stderr)
    if wrong:
        raise SystemExit(f"{len(wrong)} broken links")
    count = len(list(out.rglob("*.html")))
    print(f"{count} pages in {out}: " + ", ".join(f"{name} {took:.1f} s" for name, took in seconds.items()))


if __name__ == "__main__":
    main()
