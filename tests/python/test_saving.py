"""What saving does to what is there: whole files or none, links, permissions, pipes."""

from __future__ import annotations

import os
import stat
import threading

import h5py
import pytest
from scenes import cradle_run

import saltus


def mode_of(path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_a_link_stays_and_its_target_is_replaced(tmp_path):
    (tmp_path / "far").mkdir()
    real, link = tmp_path / "far" / "real.h5", tmp_path / "link.h5"
    real.write_text("old")
    link.symlink_to("far/real.h5")
    cradle_run().save(link)
    assert link.is_symlink()
    assert h5py.is_hdf5(real)
    assert saltus.load(link).summary() == cradle_run().summary()
    real.unlink()
    cradle_run().save(link)  # one that points nowhere yet
    assert link.is_symlink()
    assert h5py.is_hdf5(real)
    assert os.listdir(tmp_path / "far") == ["real.h5"]


def test_a_link_into_no_folder(tmp_path):
    (tmp_path / "link.h5").symlink_to(tmp_path / "nowhere" / "real.h5")
    with pytest.raises(saltus.ModelError, match=r"link to .* there is no folder"):
        cradle_run().save(tmp_path / "link.h5")


def test_a_pipe_is_left_alone(tmp_path):
    pipe = tmp_path / "pipe.h5"
    os.mkfifo(pipe)
    (tmp_path / "link.h5").symlink_to(pipe)
    for path in (pipe, tmp_path / "link.h5"):
        with pytest.raises(saltus.ModelError, match="is no regular file"):
            cradle_run().save(path)
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert sorted(os.listdir(tmp_path)) == ["link.h5", "pipe.h5"]


def test_a_device_is_left_alone():
    with pytest.raises(saltus.ModelError, match="is no regular file"):
        cradle_run().save("/dev/full")
    assert not os.path.isfile("/dev/full")


@pytest.mark.parametrize("mode", [0o600, 0o644, 0o664])
def test_permissions_are_kept(tmp_path, mode):
    path = tmp_path / "run.h5"
    path.write_text("old")
    path.chmod(mode)
    cradle_run().save(path)
    assert mode_of(path) == mode
    assert h5py.is_hdf5(path)


def test_a_new_file_has_those_of_any_new_file(tmp_path):
    (tmp_path / "other").write_text("")
    cradle_run().save(tmp_path / "run.h5")
    assert mode_of(tmp_path / "run.h5") == mode_of(tmp_path / "other")


def test_files_of_others_stay(tmp_path):
    for name in ("run.h5.part", ".run.h5.part", "run.part"):
        (tmp_path / name).write_text("mine")
    cradle_run().save(tmp_path / "run.h5")
    for name in ("run.h5.part", ".run.h5.part", "run.part"):
        assert (tmp_path / name).read_text() == "mine"
    assert len(list(tmp_path.iterdir())) == 4


def test_a_long_name(tmp_path):
    path = tmp_path / ("x" * 252 + ".h5")
    cradle_run().save(path)
    assert h5py.is_hdf5(path)


def test_two_that_save_at_once_leave_one_whole_file(tmp_path):
    """Both write, neither is done, both put theirs in place: it is then of one of them."""
    path, both = tmp_path / "run.h5", threading.Barrier(2)
    runs = [saltus.simulate(cradle_run().model, duration=t, progress=False) for t in (0.1, 0.2)]
    failed = []

    def save(run: saltus.Trajectory) -> None:
        try:
            for _ in range(20):
                both.wait()
                run.save(path)
        except BaseException as error:
            failed.append(error)
            both.abort()

    threads = [threading.Thread(target=save, args=(run,)) for run in runs]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failed
    assert saltus.load(path).summary() in [run.summary() for run in runs]
    assert os.listdir(tmp_path) == ["run.h5"]


def test_content_is_on_the_disk_before_its_name(tmp_path, monkeypatch):
    done, kinds = [], {stat.S_IFREG: "file", stat.S_IFDIR: "folder"}
    sync, replace = os.fsync, os.replace

    def fsync(file: int) -> None:
        done.append(f"fsync {kinds[stat.S_IFMT(os.fstat(file).st_mode)]}")
        sync(file)

    def replaced(old, new) -> None:
        done.append("replace")
        replace(old, new)

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr(os, "replace", replaced)
    cradle_run().save(tmp_path / "run.h5")
    assert done == ["fsync file", "replace", "fsync folder"]


def test_an_interrupted_save_leaves_nothing(tmp_path, monkeypatch):
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("saltus.records.files._write", interrupt)
    with pytest.raises(KeyboardInterrupt):
        cradle_run().save(tmp_path / "run.h5")
    assert list(tmp_path.iterdir()) == []
