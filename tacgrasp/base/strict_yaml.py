"""YAML as people write it for this program, read strictly and within bounds.

The stock loader takes the last of two equal keys in silence, unfolds aliases without end, and
raises errors of its own for an impossible date or a number of thousands of digits. Here each of
them is one line that names the place.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Hashable
from functools import lru_cache
from pathlib import Path
from typing import Any

import yaml
from yaml.constructor import ConstructorError

MAX_CHARACTERS = 50_000
"""Longest text that is read; the largest file that comes along has 3,000. Our choice."""

MAX_DEPTH = 20
"""Deepest nesting; a rig's file has four levels. Our choice."""

MAX_NUMBER_CHARACTERS = 40
"""Longest number or date; a double with its sign and exponent has 24. Our choice."""

_DATE = re.compile(r"\d{4}-\d\d?-\d\d?")
_UNQUOTED = ("int", "float", "timestamp")


class YamlError(Exception):
    """A text that is not read as YAML; one line, with the number of the text's line."""


class YamlSyntaxError(YamlError):
    """The text is not YAML, or YAML of a kind that a plain sentence can be by accident."""


class _Refused(yaml.MarkedYAMLError):
    """What this loader refuses beside what is no YAML."""


class _StrictLoader(yaml.SafeLoader):
    """Plain values in mappings and lists: no aliases, no tags, no key twice, nothing too deep."""

    _depth = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        event = self.peek_event()
        if isinstance(event, yaml.AliasEvent) or getattr(event, "anchor", None) is not None:
            problem = "anchors (&) and aliases (*) are not read; write the value out, or quote it"
            raise yaml.MarkedYAMLError(None, None, problem, event.start_mark)
        if getattr(event, "tag", None) is not None:
            problem = "tags (!) are not read; leave it out, or quote the text"
            raise yaml.MarkedYAMLError(None, None, problem, event.start_mark)
        self._depth += 1
        if self._depth > MAX_DEPTH:
            problem = f"nested deeper than {MAX_DEPTH} levels"
            raise _Refused(None, None, problem, event.start_mark)
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def construct_object(self, node: Any, deep: bool = False) -> Any:
        kind = node.tag.rpartition(":")[2]
        if kind in _UNQUOTED and len(node.value) > MAX_NUMBER_CHARACTERS:
            problem = f"a number or date of {len(node.value)} characters; at most "
            problem += f"{MAX_NUMBER_CHARACTERS} are read"
            raise _Refused(None, None, problem, node.start_mark)
        try:
            return super().construct_object(node, deep)
        except (ValueError, OverflowError):
            expected = "date" if _DATE.match(node.value) else "number"
            problem = f"{node.value!r} is no possible {expected}"
            raise _Refused(None, None, problem, node.start_mark) from None

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Hashable, Any]:
        lines: dict[str, int] = {}
        for key_node, _ in node.value:
            line = key_node.start_mark.line + 1
            if not isinstance(key_node, yaml.ScalarNode) or not key_node.tag.endswith(":str"):
                is_scalar = isinstance(key_node, yaml.ScalarNode)
                shown = repr(key_node.value)[:40] if is_scalar else "a list or mapping"
                problem = f"expected a name before the colon, got {shown}; quote it if it is one"
                raise _Refused(None, None, problem, key_node.start_mark)
            if key_node.value in lines:
                problem = f"{key_node.value[:40]} stands in line {lines[key_node.value]} already; "
                raise _Refused(None, None, problem + "keep one of both", key_node.start_mark)
            lines[key_node.value] = line
        mapping: dict[Hashable, Any] = super().construct_mapping(node, deep)
        return mapping


@lru_cache(maxsize=32)
def _loaded(text: str) -> Any:
    """Values of a document: many episodes read the same few files."""
    return yaml.load(text, Loader=_StrictLoader)


def read_yaml(text: str) -> Any:
    """Values of a YAML document: mappings with names as keys, lists, numbers, texts, dates.

    Raises:
        YamlSyntaxError: Not YAML, or with anchors, aliases or tags.
        YamlError: A key twice in one mapping (both lines are named), an impossible number or date,
            or larger or deeper than the bounds above.
    """
    if len(text) > MAX_CHARACTERS:
        raise YamlError(f"{len(text)} characters; at most {MAX_CHARACTERS} are read")
    try:
        return copy.deepcopy(_loaded(text))  # whoever reads it may change it
    except (_Refused, ConstructorError) as error:
        raise YamlError(_line(error)) from None
    except yaml.YAMLError as error:
        raise YamlSyntaxError(_line(error)) from None
    except RecursionError:  # the parser's own, before a node is complete
        raise YamlError(f"nested deeper than {MAX_DEPTH} levels") from None


def read_yaml_file(path: Path) -> Any:
    """Values of a YAML file, as ``read_yaml``; a longer file is not read to its end.

    Raises:
        YamlError: As ``read_yaml``.
        OSError: The file can't be read.
        UnicodeDecodeError: It is not UTF-8.
    """
    with path.open("rb") as file:
        data = file.read(4 * MAX_CHARACTERS + 1)
    if len(data) > 4 * MAX_CHARACTERS:
        raise YamlError(f"more than {4 * MAX_CHARACTERS} bytes; expected a short file of fields")
    return read_yaml(data.decode("utf-8"))


def _line(error: yaml.YAMLError) -> str:
    """An error in one line, without the library's copies of the text."""
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    parts = [getattr(error, name, None) for name in ("context", "problem")]
    reason = " ".join(" ".join(part for part in parts if part).split())
    if not reason:
        reason = " ".join(str(error).split())
    return reason if mark is None else f"line {mark.line + 1}: {reason}"
