"""Hooks of mkdocs: pages that are files of the repository's root, and links that leave ``docs/``.

README, CONTRIBUTING and CHANGELOG become pages as they are. A link to another file of the
repository becomes its path, since the site holds pages alone; one to a file that does not exist
stays, and ``mkdocs build --strict`` refuses it.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[1]
ROOT_PAGES = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}
LINK = re.compile(r"(!?)\[([^\]]+)\]\(([\w./-]+)(#[\w-]+)?\)")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that lie in the root."""
    from mkdocs.structure.files import File

    for source, page in ROOT_PAGES.items():
        text = (ROOT / source).read_text(encoding="utf-8")
        files.append(File.generated(config, page, content=text))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Turn links of the repository into links of the site."""
    return relinked(markdown, page.file.src_uri)


def relinked(text: str, page: str) -> str:
    """A page's text with links that hold in the site.

    Args:
        text: Markdown as it stands in the repository.
        page: Name of the page in the site.
    """
    sources = {name: source for source, name in ROOT_PAGES.items()}
    folder = posixpath.dirname(sources.get(page, f"docs/{page}"))
    here = posixpath.dirname(page)

    def relink(match: re.Match[str]) -> str:
        image, label, target, anchor = match.groups(default="")
        path = posixpath.normpath(posixpath.join(folder, target))
        if path in ROOT_PAGES:
            return f"{image}[{label}]({posixpath.relpath(ROOT_PAGES[path], here or '.')}{anchor})"
        if path.startswith("docs/"):
            return f"{image}[{label}]({posixpath.relpath(path[5:], here or '.')}{anchor})"
        if (ROOT / path).exists():
            return f"`{path}`" if label.strip("`/") == path else f"{label} (`{path}`)"
        return match[0]

    return LINK.sub(relink, text)
