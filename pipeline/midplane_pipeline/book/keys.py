"""Write docs/KEYS.md: every key of a scene and of a study, from their JSON Schemas.

    python -m midplane_pipeline.book.keys geo/scene.schema.json geo/study.schema.json > docs/KEYS.md

A key is in the schema or it is not in the program: the file is compared in `make lint`, so that it cannot fall behind."""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

Schema = dict[str, Any]

OPENING = """# All keys

Written from the JSON Schemas of the program (`midplane schema`, `midplane schema study`). Editors complete and check a scene by the
schema that its `$schema` names; `midplane schema --write` puts it beside the scene. Keys in **bold** are required. NAME stands for a name that
you choose, and `[]` for every entry of a list. [The scene file](SCENE.md) says how it is meant, with examples.
"""
SIMPLE = {"number": "number", "integer": "whole number", "string": "text", "boolean": "`true` or `false`"}


class Document:
    """The sections of one schema."""

    def __init__(self, schema: Schema) -> None:
        self.definitions: dict[str, Schema] = schema.get("$defs", {})
        self.schema = schema
        self.sections: list[tuple[str, Schema]] = []

    def resolved(self, schema: Schema) -> Schema:
        """The schema that a reference names, with what stands beside the reference first."""
        while name := self.name(schema):
            schema = {**self.definitions[name], **{key: value for key, value in schema.items() if key not in ("$ref", "allOf")}}
        return schema

    def name(self, schema: Schema) -> str:
        """The name of the definition that a schema refers to."""
        if not isinstance(schema, dict):
            return ""
        references = [schema, *schema.get("allOf", [])]
        return next((str(of["$ref"]).rpartition("/")[2] for of in references if "$ref" in of), "")

    def options(self, schema: Schema) -> list[Schema]:
        """The alternatives of a schema but for none, references still in place."""
        resolved = self.resolved(schema)
        found = resolved.get("oneOf") or resolved.get("anyOf")
        if not found:
            return [schema]
        kept = [option for option in found if option.get("type") != "null"]
        return [one for option in kept for one in (self.options(option) if len(kept) == 1 else [option])]

    def kind(self, schema: Schema, path: str) -> str:
        """What may stand as a value, in words; objects become sections of their own."""
        if not isinstance(schema, dict) or not schema.keys() - {"description", "default"}:
            return "any value"
        if self.name(schema) == "Value":
            return "number or formula"
        options = self.options(schema)
        if len(options) > 1:
            return self.choices(options, path)
        resolved = self.resolved(options[0])
        if self.name(options[0]) == "Value":
            return "number or formula"
        if "const" in resolved:
            return f"`{json.dumps(resolved['const'])}`"
        if "enum" in resolved:
            return ", ".join(f"`{json.dumps(value)}`" for value in resolved["enum"])
        kinds = resolved.get("type", [])
        kind = next((k for k in ([kinds] if isinstance(kinds, str) else kinds) if k != "null"), "")
        if kind == "array":
            return self.array(resolved, path)
        if kind == "object":
            return self.object(resolved, path)
        return SIMPLE.get(kind, kind)

    def array(self, schema: Schema, path: str) -> str:
        """A list: pairs in brackets, others by what is in them."""
        if "prefixItems" in schema:
            return "[" + ", ".join(self.kind(item, path) for item in schema["prefixItems"]) + "]"
        item = self.kind(schema["items"], f"{path}[]")
        count = schema.get("minItems") if schema.get("minItems") == schema.get("maxItems") else None
        return f"[{', '.join([item] * count)}]" if count and count <= 2 else f"list of {count or ''}{' ' if count else ''}{item}"

    def object(self, schema: Schema, path: str) -> str:
        """An object: a section of its own, or names with values of one kind."""
        if schema.get("properties"):
            self.sections.append((path, schema))
            return f"[object](#{anchor(path)})"
        inner = schema.get("additionalProperties")
        if isinstance(inner, dict):
            return "{NAME: " + self.kind(inner, f"{path}.NAME") + "}"
        return "object"

    def choices(self, options: list[Schema], path: str) -> str:
        """Alternatives, each with what it means."""
        said = []
        for option in options:
            resolved = self.resolved(option)
            properties = resolved.get("properties", {}).values()
            typed = next((of["const"] for of in properties if isinstance(of, dict) and "const" in of), None)
            if typed:
                self.sections.append((f'{path}: "{typed}"', resolved))
                said.append(f'[`"{typed}"`](#{anchor(f"""{path}: "{typed}" """)})')
            elif len(resolved.get("properties", {})) == 1 and resolved.get("type") == "object":
                ((key, value),) = resolved["properties"].items()
                said.append(f'{{`"{key}"`: {self.kind(value, f"{path}.{key}")}}}' + explained(resolved))
            else:
                several = sum(1 for other in options if self.resolved(other).get("properties")) > 1
                inner = f"{path} ({sentence(resolved.get('description', '')).rstrip('.')})" if several and resolved.get("properties") else path
                said.append(self.kind(option, inner) + (explained(resolved) if "const" in resolved or inner != path else ""))
        return "; ".join(dict.fromkeys(said))

    def lines(self, title: str) -> Iterator[str]:
        """The document, a section per object in the order in which they are met."""
        self.sections = [(title, self.schema)]
        done: set[str] = set()
        while self.sections:
            path, schema = self.sections.pop(0)
            if path in done:
                continue
            done.add(path)
            later, self.sections = self.sections, []
            required = schema.get("required", [])
            yield f"\n## {path}\n" if path == title else f"\n### {path}\n"
            if schema.get("description"):
                yield sentence(schema["description"]) + "\n"
            yield "| key | meaning | value | default |\n|---|---|---|---|"
            for key, of in schema["properties"].items():
                inner = key if path == title else f"{path.split(': ')[0]}.{key}"
                name = f"**`{key}`**" if key in required else f"`{key}`"
                meaning = of.get("description") or self.resolved(of).get("description", "")
                default = f"`{json.dumps(of['default'], ensure_ascii=False)}`" if is_told(of) else ""
                kind = self.kind(of, inner).replace("|", "\\|")
                yield f"| {name} | {sentence(meaning)} | {kind} | {default} |"
            self.sections = self.sections + later


def is_told(schema: Schema) -> bool:
    """Defaults that say something: not empty, not a whole object."""
    return "default" in schema and schema["default"] not in ("", {}, [], None) and not isinstance(schema["default"], dict)


def explained(schema: Schema) -> str:
    """The description of a choice, in brackets."""
    text = sentence(schema.get("description", "")).rstrip(".")
    return f" ({text})" if text else ""


def sentence(text: str) -> str:
    """A description on one line, fit for a table."""
    return " ".join(text.split()).replace("|", "\\|")


def anchor(title: str) -> str:
    """The anchor of a heading as GitHub and mkdocs make it."""
    kept = "".join(c for c in title.strip().lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def main() -> None:
    """Print the document."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path)
    parser.add_argument("study", type=Path)
    options = parser.parse_args()
    print(OPENING, end="")
    for title, path in (("The scene", options.scene), ("A study", options.study)):
        print("\n".join(Document(json.loads(path.read_text(encoding="utf-8"))).lines(title)))


if __name__ == "__main__":
    main()
