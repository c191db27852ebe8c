"""The notebook of examples/, its cells carried out from top to bottom against the running server."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

NOTEBOOK = Path(__file__).parent.parent / "examples" / "virtual_ur.ipynb"


def test_the_notebook_runs_top_to_bottom_and_sees_the_motion_it_commands() -> None:
    names: dict[str, Any] = {}
    for cell in json.loads(NOTEBOOK.read_text(encoding="utf8"))["cells"]:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), str(NOTEBOOK), "exec"), names)
    turned = names["table"]["q1_rad"]
    assert turned.max() - turned.min() > 0.3
    assert names["plan"]["kind"] == "planned"
