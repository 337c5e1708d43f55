"""Run the notebooks of the documentation, and write each with its results as a page of Markdown and its figures.

    python3 python/notebooks.py [-o FOLDER] [--pictures FOLDER] [NOTEBOOK.ipynb ...]

Without names all of docs/notebooks are run; pages go to target/python/notebooks. --pictures writes the figure of the cell with the tag
"picture" as a PNG of the notebook's name, which docs/images/notebooks has. A cell that fails ends the run with status 1.
"""

from __future__ import annotations

import argparse
import base64
import os
import resource
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

#: The repository, in which notebooks are found from whatever folder this is called.
ROOT = Path(__file__).resolve().parent.parent

#: Longest time of a cell in s. The slowest takes some seconds of processor time, but the machine may have other work.
CELL_S = 1200

#: Largest size of a picture of the documentation in bytes, so that the page that shows them all stays light.
PICTURE_BYTES = 100_000


def settled(scratch: str) -> None:
    """Have kernels draw into the notebook, be of this environment, and leave nothing behind."""
    os.environ["TMPDIR"] = scratch
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    os.environ["JUPYTER_PREFER_ENV_PATH"] = "1"
    for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR"):
        os.environ[name] = os.path.join(scratch, "jupyter")


def executed(source: Path, scratch: str) -> Any:
    """Run a notebook in a folder of its own; return it with its outputs, or raise the error of a cell."""
    import nbformat
    from nbclient import NotebookClient

    read: Any = nbformat.read
    notebook = read(source, as_version=4)
    nbformat.validate(notebook)
    if any(cell.cell_type == "code" and cell.outputs for cell in notebook.cells):
        raise ValueError(f"{source.name}: expected cells without outputs, found some")
    folder = os.path.join(scratch, source.stem)
    os.makedirs(folder)
    client = NotebookClient(
        notebook,
        timeout=CELL_S,
        startup_timeout=CELL_S,
        kernel_name="python3",
        # It warns of every start that it listens at a port of this machine.
        extra_arguments=["--log-level=ERROR"],
        resources={"metadata": {"path": folder}},
    )
    client.execute()
    return notebook


def written(notebook: Any, name: str, output: Path) -> None:
    """Write a notebook's page, and its figures into a folder beside it."""
    from nbconvert import MarkdownExporter

    figures = {"output_files_dir": f"{name}_files"}
    exporter: Any = MarkdownExporter
    page, resources = exporter().from_notebook_node(notebook, resources=figures)
    for file, data in resources["outputs"].items():
        path = output / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    output.joinpath(f"{name}.md").write_text(page, encoding="utf-8")


def picture(notebook: Any, name: str) -> bytes:
    """Return the figure of the cell that has the tag "picture"."""
    for cell in notebook.cells:
        if "picture" in cell.metadata.get("tags", []):
            for output in cell.outputs:
                if "image/png" in output.get("data", {}):
                    return base64.b64decode(output["data"]["image/png"])
    raise ValueError(f'{name}: expected a cell with the tag "picture" that draws a figure, found none')


def processor_s() -> float:
    """Return the processor time of kernels that have ended, in s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(source: Path, asked: argparse.Namespace, scratch: str) -> None:
    """Run one notebook and write what is asked for."""
    began, used = time.monotonic(), processor_s()
    notebook = executed(source, scratch)
    written(notebook, source.stem, asked.output)
    data = picture(notebook, source.name)
    if len(data) > PICTURE_BYTES:
        raise ValueError(f"{source.name}: expected a picture of at most {PICTURE_BYTES} bytes, found {len(data)}")
    if asked.pictures is not None:
        asked.pictures.joinpath(f"{source.stem}.png").write_bytes(data)
    took = f"{processor_s() - used:.0f} s of processor time, {time.monotonic() - began:.0f} s"
    print(f"{source.name}: {took}", flush=True)


def main() -> None:
    """Run the notebooks that are named, or all."""
    parser = argparse.ArgumentParser(description="Run the notebooks of the documentation.")
    parser.add_argument("notebooks", nargs="*", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "target/python/notebooks")
    parser.add_argument("--pictures", type=Path)
    asked = parser.parse_args()
    sources = asked.notebooks or sorted(ROOT.joinpath("docs/notebooks").glob("*.ipynb"))
    if not sources:
        sys.exit("no notebook in docs/notebooks")
    for folder in (asked.output, asked.pictures):
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
    failed = []
    with tempfile.TemporaryDirectory() as scratch:
        settled(scratch)
        for source in sources:
            try:
                run(source, asked, scratch)
            # Whatever a notebook meets, the others are run, and the reason is told.
            except Exception as error:
                print(f"{source.name}: {error}", file=sys.stderr)
                failed.append(source.name)
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
