"""A hook of mkdocs: on phones a figure is shown with its panels below each other, from ``*-narrow.png`` beside it.

`docs/images/make_from_pages.py` draws both.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

IMAGES = Path(__file__).resolve().parent / "images"
PICTURE = re.compile(r'<img [^>]*src="([^"]*images/([\w-]+))\.png"[^>]*>')
NARROW = "(max-width: 600px)"


def on_page_content(html: str, **_: Any) -> str:
    """The page with two sources for such figures."""
    return PICTURE.sub(_with_both, html)


def _with_both(match: re.Match[str]) -> str:
    if not (IMAGES / f"{match[2]}-narrow.png").exists():
        return match[0]
    source = f'<source media="{NARROW}" srcset="{match[1]}-narrow.png">'
    return f"<picture>{source}{match[0]}</picture>"
