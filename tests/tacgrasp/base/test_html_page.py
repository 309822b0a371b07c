"""Pages from templates: whole, closed to the network, and with every text escaped."""

import jinja2
import pytest

from tacgrasp.base.html_page import render_page


def test_a_page_loads_nothing_and_escapes_text() -> None:
    page = render_page("base/templates/page.html", title="<script>alert(1)</script>")
    assert page.startswith("<!doctype html>")
    assert page.endswith("</html>\n")
    assert "content=\"default-src 'none'; img-src data:;" in page
    assert "<title>&lt;script&gt;alert(1)&lt;/script&gt;</title>" in page


def test_a_template_that_names_an_unknown_value_is_refused() -> None:
    with pytest.raises(jinja2.UndefinedError, match="sections"):
        render_page("pretraining/templates/report.html", title="x")
