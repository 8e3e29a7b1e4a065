"""The programs that make the numbers of the paper, docs/paper: how numbers are written, and which results are kept."""

import importlib
import os
import pathlib
import sys

import pytest

PAPER = pathlib.Path(os.environ["CAROM_SOURCE_DIR"]) / "docs" / "paper"


@pytest.fixture(autouse=True)
def paper_on_path(monkeypatch):
    monkeypatch.syspath_prepend(str(PAPER))
    yield
    for name in [n for n in sys.modules if n in ("tex_numbers", "kept_results", "make_paper", "gnuplot") or n.startswith("experiments")]:
        del sys.modules[name]


def test_numbers_keep_their_significant_digits():
    tex = importlib.import_module("tex_numbers")
    assert tex.significant(0.08349) == "0.083"
    assert tex.significant(9.96, 2) == "10"
    assert tex.significant(1234.6, 2) == "1200"
    assert tex.significant(3.14e-14) == r"\ensuremath{3.1\times 10^{-14}}"
    assert tex.significant(9.99e-15, 1) == r"\ensuremath{1\times 10^{-14}}"
    assert tex.significant(0.0) == "0"
    assert tex.with_error(1.108384, 0.0000287) == "1.108384(29)"
    assert tex.with_error(4.1052, 0.00103) == "4.1052(10)"
    assert tex.with_error(1.0, 0.0996) == "1.00(10)"
    assert tex.with_error(25.0, 3.2) == "25.0(3.2)"
    assert tex.with_error(1250.0, 32.0) == "1250(32)"
    assert [tex.count(n) for n in (256, 10_000, 20_000)] == ["256", r"\ensuremath{10^{4}}", r"20\,000"]
    assert tex.word("50 %_x") == r"50 \%\_x"


def test_the_virial_series_is_continued_to_the_published_values():
    state = importlib.import_module("experiments.equation_of_state")
    assert state.published(0.1) == pytest.approx(1.236144, abs=2e-6)
    assert state.published(0.3) == pytest.approx(2.06326, abs=5e-5)
    assert state.published(0.5) == pytest.approx(4.106, abs=2e-3)
    assert state.uncertainty(0.3) < 1e-5 and 5e-5 < state.uncertainty(0.5) < 1e-3, "approximants of other degrees agree"
    assert 4096 * state.of_finite_box(0.3) == pytest.approx(0.7741, abs=1e-3), "64 disks gave 0.774 +- 0.015"
    assert state.collision_rate(state.published(0.5)) == pytest.approx(7.007, rel=1e-3)


def test_all_experiments_are_kept_with_commit_machine_and_hashes():
    kept = importlib.import_module("kept_results")
    names = importlib.import_module("experiments").NAMES
    assert sorted(names) == sorted(f.stem for f in (PAPER / "results").glob("*.json"))
    for name in names:
        result = kept.kept(name)
        assert result["experiment"] == name and result["rows"]
        assert len(result["commit"]) == 8 and "-dirty" not in result["commit"], name
        assert result["machine"]["cores"] >= 1 and result["machine"]["processor"]
        for row in result["rows"]:
            assert len(row.get("state_hash") or "0" * 16) == 16, name


def test_typed_decimals_are_found(monkeypatch, tmp_path):
    paper = importlib.import_module("make_paper")
    assert paper.typed_numbers() == []
    (tmp_path / "speed.tex").write_text("a ratio of \\result{a.b_0.5} at $\\phi = 0.5$\n% 2.5\nis 2.5\n")
    monkeypatch.setattr(paper, "HERE", tmp_path)
    assert paper.typed_numbers() == ["speed.tex:3: is 2.5"]
