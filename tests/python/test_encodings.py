"""Files in other encodings than UTF-8, and what no text is."""

from __future__ import annotations

import pickle
import warnings

import pytest

import saltus

TEXT = '<robot name="r"><!-- für den Hörsaal -->\n<link name="gelenk_ü"/></robot>'
HEAD = '<?xml version="1.0" encoding="{}"?>'


def load(folder, data: bytes, **options) -> saltus.Model:
    (folder / "r.urdf").write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return saltus.load_urdf(folder / "r.urdf", **options)


@pytest.mark.parametrize(
    ("name", "codec"),
    [
        ("ISO-8859-1", "latin-1"),
        ("latin1", "latin-1"),
        ("windows-1252", "cp1252"),
        ("utf-8", "utf-8"),
        ("UTF-8", "utf-8-sig"),
        ("UTF-16", "utf-16"),
        ("utf-16", "utf-16-be"),
        ("utf-16le", "utf-16-le"),
    ],
)
def test_the_declaration_holds(tmp_path, name, codec):
    model = load(tmp_path, (HEAD.format(name) + TEXT).encode(codec), strict=True)
    assert model.link_names == ["gelenk_ü"]
    assert "Hörsaal" in model.source
    # The text is UTF-8 now and says so, wherever it goes.
    assert load(tmp_path, model.source.encode(), strict=True).source == model.source
    assert pickle.loads(pickle.dumps(model)).link_names == model.link_names


def test_letters_of_windows_and_beyond(tmp_path):
    letters = "€‚ƒ„…†‡ˆ‰Š‹ŒŽ‘’“”•–—˜™š›œžŸÿ"
    text = TEXT.replace("ü", letters)
    model = load(tmp_path, (HEAD.format("Windows-1252") + text).encode("cp1252"))
    assert model.link_names == [f"gelenk_{letters}"]
    beyond = TEXT.replace("ü", "𝄞\uffffé")
    model = load(tmp_path, (HEAD.format("utf-16") + beyond).encode("utf-16"))
    assert model.link_names == ["gelenk_𝄞\uffffé"]


def test_a_run_of_such_a_file_is_saved(tmp_path):
    model = load(tmp_path, (HEAD.format("ISO-8859-1") + TEXT).encode("latin-1"))
    saltus.simulate(model, duration=0.1).save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model.link_names == ["gelenk_ü"]


@pytest.mark.parametrize("head", ["", HEAD.format("utf-8")])
@pytest.mark.parametrize(
    "bad", [b"\xfc", b"\xc3", b"\xc0\xaf", b"\xed\xa0\x80", b"\xf5\x80\x80\x80"]
)
def test_bytes_that_are_no_utf_8(tmp_path, head, bad):
    data = (head + TEXT).encode().replace("ü".encode(), bad, 1)
    data = data.replace("gelenk_ü".encode(), b"gelenk_" + bad)
    with pytest.raises(saltus.ModelError, match=r"r\.urdf: has bytes that are no UTF-8, .* line 1"):
        load(tmp_path, data, strict=True)
    with pytest.warns(saltus.ModelWarning, match="read as windows-1252"):
        model = saltus.load_urdf(tmp_path / "r.urdf")
    assert model.link_names == ["gelenk_" + bad.decode("cp1252")]


def test_a_bad_byte_in_a_number_is_an_error_in_words(tmp_path):
    body = '<inertial><mass value="0.\xff"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
    text = f'<robot name="r"><link name="a">{body}</link></robot>'
    with pytest.raises(saltus.ModelError, match=r'"0\.ÿ" is not a number'):
        load(tmp_path, text.encode("latin-1"))


def test_an_encoding_that_is_not_known(tmp_path):
    with pytest.raises(saltus.ModelError, match=r'r.urdf: is in encoding "KOI8-R".*iconv -f KOI8'):
        load(tmp_path, (HEAD.format("KOI8-R") + TEXT).encode("latin-1"))
    with pytest.raises(saltus.ModelError, match="no UTF-16: half a character"):
        load(tmp_path, "<robot>".encode("utf-16-le") + b"\x00\xd8<\x00")


def test_text_in_memory_is_what_it_is():
    text = HEAD.format("KOI8-R") + TEXT
    assert saltus.load_urdf(text, strict=True).source == text


@pytest.mark.parametrize("end", [b"\0", b"\0\0\0", b"\n\0\n", b" \0 \0"])
def test_zero_bytes_at_the_end(tmp_path, end):
    data = TEXT.encode() + end
    with pytest.raises(saltus.ModelError, match=r"r\.urdf: ends with a zero byte"):
        load(tmp_path, data, strict=True)
    with pytest.warns(saltus.ModelWarning, match="ends with a zero byte"):
        model = saltus.load_urdf(tmp_path / "r.urdf")
    assert model.source.strip() == TEXT
    with pytest.warns(saltus.ModelWarning, match="URDF text: ends with a zero byte"):
        saltus.load_urdf(TEXT + "\0")


def test_zero_bytes_elsewhere(tmp_path):
    for data in (TEXT.encode().replace(b"link", b"li\0nk"), b"\0", b"\0\0\0\0", b"<\0"):
        with pytest.raises(saltus.ModelError):
            load(tmp_path, data)


def test_srdf_too(tmp_path):
    rule = '<robot name="r"><disable_collisions link1="gelenk_ü" link2="gelenk_ü"/></robot>'
    (tmp_path / "r.srdf").write_bytes((HEAD.format("ISO-8859-1") + rule).encode("latin-1"))
    load(tmp_path, TEXT.encode(), srdf=tmp_path / "r.srdf", strict=True)
    (tmp_path / "r.srdf").write_bytes(rule.encode("latin-1"))
    with pytest.raises(saltus.ModelError, match=r"r\.srdf: has bytes that are no UTF-8"):
        load(tmp_path, TEXT.encode(), srdf=tmp_path / "r.srdf", strict=True)
    with pytest.warns(saltus.ModelWarning, match=r"r\.srdf: has bytes"):
        saltus.load_urdf(tmp_path / "r.urdf", srdf=tmp_path / "r.srdf")
