"""Every page with code as a notebook: a hook of mkdocs, and ``python docs/notebooks.py FOLDER`` on its own.

A ``python`` block becomes a code cell, with the ``output`` block below it as its output; what lies between blocks
becomes text, with pictures inside, so that a notebook can be taken anywhere. Links lead to other notebooks in the same
folder.
"""

from __future__ import annotations

import base64
import json
import posixpath
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parent

BLOCK = re.compile(r"^([ \t]*)```python[ \t]*\n(.*?)^\1```[ \t]*$", re.MULTILINE | re.DOTALL)
OUTPUT = re.compile(r"\s*^([ \t]*)```output[ \t]*\n(.*?)^\1```[ \t]*$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"!\[([^\]]*)\]\(([^)\s#]+)(?:#[^)\s]*)?\)(?:\{[^}]*\})?")
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s:]+\.md)(#[^)\s]*)?\)")
ADMONITION = re.compile(
    r'^!!! (\w+)(?: "([^"]*)")?[ \t]*\n((?:(?:    .*|[ \t]*)\n?)+)', re.MULTILINE
)
HEADLINE = re.compile(r"^# .*\n", re.MULTILINE)
CHECKOUT = re.compile(r"^\s*(?:from|import) (?:examples|tests|benchmarks)\b", re.MULTILINE)
COMMENT = re.compile(r"<!--.*?-->[ \t]*\n?", re.DOTALL)

KINDS = {".png": "image/png", ".svg": "image/svg+xml", ".jpg": "image/jpeg"}


def has_code(text: str) -> bool:
    """Whether a page has a block that runs."""
    return BLOCK.search(text) is not None


def notebook_path(page: str) -> str:
    """Where a page's notebook lies, relative to the site: all are in one folder."""
    return "notebooks/" + page.removesuffix(".md").replace("/", "-") + ".ipynb"


def notebook(page: str, text: str) -> dict[str, Any]:
    """The notebook of a page, as JSON.

    Arguments:
        page: its path below docs/, as ``gallery/motor.md``.
        text: what it says.
    """
    cells: list[dict[str, Any]] = []
    if any(CHECKOUT.search(match[2]) for match in BLOCK.finditer(text)):
        _add_text(
            cells, page, "*Start Jupyter in the root of a checkout: this page uses its examples.*"
        )
    end = 0
    for match in BLOCK.finditer(text):
        _add_text(cells, page, text[end : match.start()])
        output = OUTPUT.match(text, match.end())
        end = output.end() if output else match.end()
        code, printed = textwrap.dedent(match[2]), output and textwrap.dedent(output[2])
        _add_code(cells, code, printed)
    _add_text(cells, page, text[end:])
    for number, cell in enumerate(cells):
        cell["id"] = f"cell-{number}"
    return {
        "cells": cells,
        "metadata": {
            "kernelspec": {
                "display_name": "Python 3 (ipykernel)",
                "language": "python",
                "name": "python3",
            },
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }


def _add_code(cells: list[dict[str, Any]], code: str, printed: str | None) -> None:
    outputs = [] if printed is None else [_printed(printed)]
    cells.append(
        {
            "cell_type": "code",
            "execution_count": None,
            "metadata": {},
            "outputs": outputs,
            "source": code.strip("\n"),
        }
    )


def _printed(text: str) -> dict[str, Any]:
    return {"name": "stdout", "output_type": "stream", "text": text}


def _add_text(cells: list[dict[str, Any]], page: str, text: str) -> None:
    """A cell of text with the pictures that it shows; none where there is nothing to say."""
    pictures: dict[str, dict[str, str]] = {}
    folder = (DOCS / page).parent

    def attach(match: re.Match[str]) -> str:
        path = (folder / match[2]).resolve()
        kind = KINDS.get(path.suffix)
        if kind is None or not path.is_file():
            return match[0]
        pictures[path.name] = {kind: base64.b64encode(path.read_bytes()).decode()}
        return f"![{match[1]}](attachment:{path.name})"

    def lead(match: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(page), match[2]))
        path = DOCS / target
        if path.is_file() and has_code(path.read_text(encoding="utf-8")):
            return f"[{match[1]}]({Path(notebook_path(target)).name})"
        return match[1]

    text = COMMENT.sub("", text)
    text = ADMONITION.sub(_quoted, text)
    text = LINK.sub(lead, PICTURE.sub(attach, text)).strip()
    if text:
        cell: dict[str, Any] = {"cell_type": "markdown", "metadata": {}, "source": text}
        cells.append(cell | ({"attachments": pictures} if pictures else {}))


def _quoted(match: re.Match[str]) -> str:
    """An admonition as a quotation, which notebooks know."""
    title = match[2] if match[2] is not None else match[1].capitalize()
    body = textwrap.dedent(match[3]).strip("\n")
    lines = [f"**{title}**", "", *body.splitlines()] if title else body.splitlines()
    return "\n".join(f"> {line}".rstrip() for line in lines) + "\n\n"


def pages() -> list[Path]:
    """The pages that have code."""
    found = sorted(DOCS.rglob("*.md"))
    return [page for page in found if has_code(page.read_text(encoding="utf-8"))]


def text_of(page: str) -> str:
    """A page's notebook as the text of its file."""
    content = notebook(page, (DOCS / page).read_text(encoding="utf-8"))
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


# -- what mkdocs calls -----------------------------------------------------------------------------


def on_files(files: Any, *, config: Any) -> Any:
    """Put the notebooks among the files of the site."""
    from mkdocs.structure.files import File

    for path in pages():
        page = path.relative_to(DOCS).as_posix()
        files.append(File.generated(config, notebook_path(page), content=text_of(page)))
    return files


def on_page_markdown(markdown: str, *, page: Any, config: Any, files: Any) -> str:
    """Link a page to its notebook, below its headline."""
    source = page.file.src_uri
    if not has_code(markdown):
        return markdown
    up = "../" * source.count("/")
    link = f"[Download as a notebook]({up}{notebook_path(source)}){{ .notebook download }}"
    return HEADLINE.sub(lambda found: f"{found[0]}\n{link}\n", markdown, count=1)


def main() -> None:
    """Write all notebooks into a folder."""
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for path in pages():
        page = path.relative_to(DOCS).as_posix()
        (folder / Path(notebook_path(page)).name).write_text(text_of(page), encoding="utf-8")


if __name__ == "__main__":
    main()
