"""Videos: their frames are the page at their times; errors in words; nothing is left behind."""

from __future__ import annotations

import base64

import numpy as np
import pytest
from browser import pixels, started_with, until
from scenes import cradle, cradle_run

import saltus

RATE, SLOW, SIZE = 10, 2.5, (320, 240)

DECODE = """(async () => {
  const bytes = Uint8Array.from(atob('%s'), (c) => c.charCodeAt(0));
  const video = document.createElement('video');
  video.muted = true;
  video.src = URL.createObjectURL(new Blob([bytes], { type: 'video/webm' }));
  const event = (name) => new Promise((done) => video.addEventListener(name, done, { once: true }));
  await event('loadeddata');
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
  const frames = [];
  for (let k = 0; k < %d; k++) {
    const sought = event('seeked');
    video.currentTime = (k + 0.5) / %d;
    await sought;
    // A busy browser may tell of the seek before it has the frame: all frames differ, so that one
    // that is the last is asked for again.
    let frame;
    for (let asked = 0; asked < 40; asked++) {
      canvas.getContext('2d').drawImage(video, 0, 0);
      frame = canvas.toDataURL('image/png').split(',')[1];
      if (frame !== frames.at(-1)) break;
      await new Promise((done) => setTimeout(done, 50));
    }
    frames.push(frame);
  }
  return [video.duration, frames];
})()"""


@pytest.fixture(scope="module")
def run() -> saltus.Trajectory:
    # Fast from the start, so that frames differ by more than what VP9 loses.
    fast = {"swing_0": -3.0}
    return saltus.simulate(cradle(), {"swing_0": 0.5}, fast, duration=0.4, progress=False)


def test_frames_are_the_page_at_their_times(run, open_page, tmp_path, monkeypatch):
    monkeypatch.setenv("SALTUS_TEST_OF_VIDEO", "1")
    run.video(tmp_path / "run.webm", rate=RATE, slow=SLOW, size=SIZE)
    assert [path.name for path in tmp_path.iterdir()] == ["run.webm"]
    until(lambda: not started_with("SALTUS_TEST_OF_VIDEO=1"))  # nothing of Chromium is left
    data = (tmp_path / "run.webm").read_bytes()
    assert data[:4] == b"\x1a\x45\xdf\xa3"  # a Matroska file

    tab = open_page(run)
    count = int(0.4 * RATE * SLOW) + 1
    duration, frames = tab.run(DECODE % (base64.b64encode(data).decode(), count, RATE))
    assert duration == pytest.approx((count - 1) / RATE, abs=1e-3)  # of the last frame, its start
    decoded = [pixels(base64.b64decode(frame)) for frame in frames]
    tab.run("saltus.page.stage.sun.castShadow = true")  # videos always have shadows
    tab.run(f"saltus.page.setTheme('light'), saltus.page.beginVideo({list(SIZE)}, 1)")
    drawn = []
    for k in range(count):
        tab.run(f"saltus.page.clock.time = {k / (RATE * SLOW)}")
        drawn.append(tab.picture())
    far = np.array([[np.abs(a - b).mean() for b in drawn] for a in decoded])
    assert drawn[0].shape == decoded[0].shape == (SIZE[1], SIZE[0], 3)
    assert far.argmin(axis=1).tolist() == list(range(count))
    assert np.diag(far).max() < 3  # of 255: what VP9 loses


def test_without_chromium_it_says_what_to_install(run, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("SALTUS_CHROMIUM", raising=False)
    with pytest.raises(saltus.ModelError, match=r"none was found .*apt-get install chromium"):
        run.video(tmp_path / "run.webm")
    monkeypatch.setenv("SALTUS_CHROMIUM", "no-such-browser")
    with pytest.raises(saltus.ModelError, match="SALTUS_CHROMIUM=no-such-browser: there is no"):
        run.video(tmp_path / "run.webm")
    assert not list(tmp_path.iterdir())


def test_a_browser_that_ends_is_said(run, tmp_path, monkeypatch):
    monkeypatch.setenv("SALTUS_CHROMIUM", "false")
    with pytest.raises(saltus.ModelError, match="Chromium ended with code 1 before the video"):
        run.video(tmp_path / "run.webm")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("run.mp4", {}, r"their names end with \.webm"),
        ("run.webm", {"rate": 0}, "rate = 0; it is a number above 0"),
        ("run.webm", {"slow": float("nan")}, "slow = nan"),
        ("run.webm", {"size": (8, 8)}, "size = 8 x 8"),
        ("run.webm", {"view": "back"}, 'no view "back"; views are corner, front'),
        ("run.webm", {"rate": 1e9}, "frames, more than"),
        ("no/run.webm", {}, "there is no folder"),
    ],
)
def test_wrong_arguments_are_named_before_the_work(run, name, options, words, tmp_path):
    with pytest.raises(saltus.ModelError, match=words):
        run.video(tmp_path / name, **options)


def test_a_link_to_follow_is_one_that_moves(browser, tmp_path):
    with pytest.raises(saltus.ModelError, match=r'no moving link "ball_7".*ball_0'):
        cradle_run().video(tmp_path / "run.webm", follow="ball_7")
