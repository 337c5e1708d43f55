"""The reference of the Python package, read from its sources: nothing is imported, so that nothing has to be built."""

from __future__ import annotations

import ast
import re
from pathlib import Path

from sphinx.ext.napoleon import Config, NumpyDocstring

#: How docstrings in numpy's form become reStructuredText.
NAPOLEON = Config(napoleon_use_ivar=True, napoleon_use_rtype=False, napoleon_use_param=True)

#: The package that is described.
PACKAGE = Path("python/unripple")

INTRODUCTION = """\
Reference of the Python package
===============================

Everything that ``import unripple`` offers. Options that a command has in common with the command line (the ``**options`` here) have its
names: :doc:`a table </docs/python-parity>` lists them, and ``unripple COMMAND --help`` explains them.
:doc:`In Python </docs/python>` is the guide.

.. py:module:: unripple

"""


class Package:
    """The modules of the package, as syntax trees."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.modules: dict[str, ast.Module] = {}

    def module(self, name: str) -> ast.Module:
        """Return a module by its full name."""
        if name not in self.modules:
            file = self.folder / f"{name.rpartition('.')[2]}.py" if "." in name else self.folder / "__init__.py"
            self.modules[name] = ast.parse(file.read_text(encoding="utf-8"))
        return self.modules[name]

    def imported(self, module: str) -> dict[str, str]:
        """Return which module each imported name of a module comes from."""
        statements = [node for node in ast.walk(self.module(module)) if isinstance(node, ast.ImportFrom)]
        return {alias.name: node.module for node in statements for alias in node.names if node.module}

    def find(self, name: str, module: str) -> tuple[ast.ClassDef | ast.FunctionDef, str] | None:
        """Return the definition of a name and the module that has it."""
        for node in self.module(module).body:
            if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name == name:
                return node, module
        origin = self.imported(module).get(name)
        return self.find(name, origin) if origin and origin.startswith("unripple.") else None

    def members(self, node: ast.ClassDef, module: str) -> dict[str, ast.FunctionDef]:
        """Return the documented public methods of a class by name, its own and those that it inherits."""
        found: dict[str, ast.FunctionDef] = {}
        for base in node.bases:
            above = self.find(base.id, module) if isinstance(base, ast.Name) else None
            if above and isinstance(above[0], ast.ClassDef):
                found |= self.members(above[0], above[1])
        for item in node.body:
            if isinstance(item, ast.FunctionDef) and not item.name.startswith("_") and ast.get_docstring(item):
                found[item.name] = item
        return found

    def public(self) -> list[str]:
        """Return the names in `__all__`."""
        for node in self.module("unripple").body:
            if isinstance(node, ast.Assign) and any(isinstance(to, ast.Name) and to.id == "__all__" for to in node.targets):
                return list(ast.literal_eval(node.value))
        raise ValueError("python/unripple/__init__.py: expected `__all__`, found none")


def signature(node: ast.FunctionDef, method: bool) -> str:
    """Return what a function takes and returns, with its own object left out."""
    arguments = ast.parse(ast.unparse(node)).body[0]
    assert isinstance(arguments, ast.FunctionDef)
    ordered = arguments.args.posonlyargs or arguments.args.args
    if method and ordered:
        ordered.pop(0)
    # Types of options stand in modules of their own: _types, _plan_types, _bench_types.
    text = re.sub(r"\b_(?:\w+_)?types\.", "", ast.unparse(arguments.args))
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"({text}){returned}"


def described(docstring: str, depth: int) -> list[str]:
    """Return a docstring as indented lines of reStructuredText."""
    lines = str(NumpyDocstring(docstring, NAPOLEON)).splitlines()
    return [f"{'   ' * depth}{line}".rstrip() for line in lines]


def decorators(node: ast.FunctionDef) -> set[str]:
    """Return the names of what decorates a function."""
    return {item.id for item in node.decorator_list if isinstance(item, ast.Name)}


def member(node: ast.FunctionDef) -> list[str]:
    """Return the entry of a method or property of a class."""
    kinds = decorators(node)
    if "property" in kinds:
        head = f"   .. py:property:: {node.name}"
        options = [f"      :type: {ast.unparse(node.returns)}"] if node.returns else []
    else:
        of_class = "classmethod" in kinds
        head = f"   .. py:method:: {node.name}{signature(node, method='staticmethod' not in kinds)}"
        options = ["      :classmethod:"] if of_class else ["      :staticmethod:"] if "staticmethod" in kinds else []
    return [head, *options, "", *described(ast.get_docstring(node) or "", 2), ""]


def entry(package: Package, name: str) -> list[str]:
    """Return the heading and the entry of one public name."""
    found = package.find(name, "unripple")
    if found is None:
        return []
    node, module = found
    heading = [name, "-" * len(name), ""]
    text = ast.get_docstring(node) or ""
    if isinstance(node, ast.FunctionDef):
        return [*heading, f".. py:function:: {name}{signature(node, method=False)}", "", *described(text, 1), ""]
    made = next((item for item in node.body if isinstance(item, ast.FunctionDef) and item.name == "__init__"), None)
    takes = signature(made, method=True).removesuffix(" -> None") if made else ""
    # Attributes that are properties stand below, with their types and what they are.
    text = text.partition("\nAttributes\n---")[0] + "".join(text.partition("\nAttributes\n---")[2].partition("\nRaises\n---")[1:])
    out = [*heading, f".. py:class:: {name}{takes}", "", *described(text, 1), ""]
    for item in package.members(node, module).values():
        out += member(item)
    return out


def page(root: Path) -> str:
    """Return the reference as a page of reStructuredText."""
    package = Package(root / PACKAGE)
    names = sorted(package.public(), key=str.lower)
    return INTRODUCTION + "\n".join(line for name in names for line in entry(package, name)) + "\n"
