"""How a notebook becomes a page: it is executed, and its outputs are kept.

Notebooks are committed without outputs, so that what a page shows is always what the
code does.
"""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any

import nbformat
from nbclient import NotebookClient
from traitlets.config import Config

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["executed", "page_of"]


def executed(path: Path, folder: Path) -> Any:
    """Return a notebook with its outputs.

    Parameters
    ----------
    path : Path
        Of the notebook.
    folder : Path
        Where it runs.

    Raises
    ------
    nbclient.exceptions.CellExecutionError
        If a cell fails.
    """
    notebook = nbformat.read(path, as_version=4)
    # Files, not ports: nobody else on the machine can talk to the kernel.
    config = Config({"KernelManager": {"transport": "ipc"}})
    resources = {"metadata": {"path": str(folder)}}
    NotebookClient(notebook, timeout=300, resources=resources, config=config).execute()
    return notebook


def page_of(notebook: Any, name: str) -> Iterator[tuple[str, str | bytes]]:
    """Yield the files of the page of an executed notebook.

    Parameters
    ----------
    notebook : notebook
        Executed.
    name : str
        Of the page, without a suffix.
    """
    lines = []
    for k, cell in enumerate(notebook.cells):
        if cell.cell_type == "markdown":
            lines += [cell.source, ""]
            continue
        lines += ["```python", cell.source, "```", ""]
        for output in cell.outputs:
            if output.output_type == "stream":
                lines += ["```text", output.text.rstrip(), "```", ""]
                continue
            data = output.get("data", {})
            if "image/svg+xml" in data:
                picture = f"{name}-{k}.svg", data["image/svg+xml"]
            elif "image/png" in data:
                picture = f"{name}-{k}.png", base64.b64decode(data["image/png"])
            else:
                lines += ["```text", data.get("text/plain", "").rstrip(), "```", ""]
                continue
            yield picture
            lines += [f"![Output of the cell above]({picture[0]})", ""]
    yield f"{name}.md", "\n".join(lines)
