# SPDX-License-Identifier: BSD-3-Clause
"""The lines of pcl6d on the pages for users of other libraries run, in their order."""

import pathlib
import re

import numpy as np
import pytest

DOCUMENTS = pathlib.Path(__file__).resolve().parents[2] / "share/doc"


def lines_of(page):
    """(number, line) of each `pcl6d` cell: the second one of tables headed so."""
    is_ours = False
    for number, line in enumerate(page.read_text().split("\n"), 1):
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) != 2:
            is_ours = False
        elif cells[1] == "pcl6d":
            is_ours = True
        elif is_ours and set(cells[1]) != {"-"}:
            yield number, cells[1]


@pytest.mark.parametrize("page", ["from_open3d.md", "from_small_gicp.md"])
def test_lines_of_a_page_run(page, scan_folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"np": np}
    count = 0
    for number, cell in lines_of(DOCUMENTS / page):
        assert re.fullmatch("`[^`]+`", cell), f"{page}:{number}: {cell}"
        try:
            exec(cell[1:-1], names)
        except Exception as error:
            raise AssertionError(f"{page}:{number}: {cell}") from error
        count += 1
    assert count >= 20
    assert names["result"].converged and names["found"].converged
    truth = scan_folder[1]
    T = np.linalg.inv(truth[0]) @ truth[1]
    assert np.abs(names["T"] - T).max() < 0.02
    assert names["checked"].consistent
    assert len(names["run"].scans) == 3


def test_block_of_the_readme_runs(scan_folder, tmp_path, monkeypatch):
    readme = DOCUMENTS.parents[1] / "modules/python/README.md"
    blocks = re.findall(r"```python\n(.*?)```", readme.read_text(), re.S)
    assert len(blocks) == 1
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(blocks[0], names)
    assert names["run"].verdict and names["run"].map().world.shape[1] == 3
