"""HTML pages from jinja2 templates: each page is one file that needs no other.

Templates are package data, named by their path in this package. Every page extends
``base/templates/page.html``; the content security policy there forbids the browser to load
anything, so pictures, styles and scripts stand inside the page.
"""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape


@cache
def _environment() -> Environment:
    return Environment(
        loader=PackageLoader("tacgrasp", ""),
        autoescape=select_autoescape(["html"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )


def render_page(template: str, *, title: str, **values: object) -> str:
    """Fill a template; text in ``values`` is escaped where it is HTML.

    Args:
        template: Path in this package, such as ``pretraining/templates/report.html``.
        title: Title of the page, plain text.
        values: What the template names.

    Raises:
        jinja2.TemplateError: The template is missing or wrong, or names a value that is not given.
    """
    return _environment().get_template(template).render(title=title, **values)
