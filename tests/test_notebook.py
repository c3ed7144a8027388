"""The notebook of the documentation runs, and shows what it says it shows."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
NEEDED = "needs nbclient and ipykernel"


@pytest.fixture(scope="module")
def notebooks():
    pytest.importorskip("nbclient", reason=NEEDED)
    pytest.importorskip("ipykernel", reason=NEEDED)
    sys.path.insert(0, str(ROOT / "docs"))
    import notebooks

    sys.path.remove(str(ROOT / "docs"))
    return notebooks


@pytest.mark.filterwarnings("ignore")  # of the kernel's own libraries
def test_the_tour_runs_and_its_page_has_every_output(notebooks):
    tour = notebooks.executed(ROOT / "docs" / "tour.ipynb", ROOT)
    *pictures, (name, page) = notebooks.page_of(tour, "tour")
    assert name == "tour.md"
    assert len(pictures) == 4
    for path, content in pictures:
        assert f"]({path})" in page
        assert content.startswith(("<svg", "<?xml"))
    assert "correct: True" in page
    assert "accepted: True" in page
    assert " s of driving in a page of " in page
    code = [cell for cell in tour.cells if cell.cell_type == "code"]
    assert page.count("```python") == len(code)


def test_the_tour_is_kept_without_outputs():
    text = (ROOT / "docs" / "tour.ipynb").read_text()
    assert '"outputs": []' in text
    assert "output_type" not in text
