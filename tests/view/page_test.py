#!/usr/bin/env python3
"""usage: tests/view/page_test.py FATHOM
The page of `fathom view` in a browser without a network: it draws itself, and what it says of a pixel under water is what the
capture's truth has. Skipped (exit code 77) without chromium."""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CHROMIUM = shutil.which("chromium")
if not CHROMIUM:
    print("... skipped 'chromium is not installed'")
    sys.exit(77)

SCENE = {"sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]},
         "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 40}]}


def dom(page, profile, wishes=""):
    return subprocess.run(
        [CHROMIUM, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", f"--user-data-dir={profile}",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1000,800", "--virtual-time-budget=5000", "--dump-dom",
         page.as_uri() + wishes], check=True, capture_output=True, text=True, timeout=300).stdout.split("<script", 1)[0]


def row(text, name):
    """Height and depth [mm] of the table's row of that name."""
    found = re.search(rf"<td><span[^>]*>{name}</span></td><td>([\d.]+)</td><td>([\d.]*)</td>", text)
    assert found, f"no row {name}"
    return float(found[1]), float(found[2] or "nan")


def check(program, folder):
    (folder / "scene.json").write_text(json.dumps(SCENE))
    for arguments in (["capture", "scene.json", "--mode", "geometric", "-o", "shot", "--quiet"], ["view", "shot", "-o", "page.html"]):
        subprocess.run([program, *arguments], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    page = folder / "page.html"
    text = dom(page, folder / "profile")
    assert 'data-state="ready"' in text, "the page did not draw itself"
    really, depth = row(text, "true")
    raised, near = row(text, "straight rays meet")
    paper, _ = row(text, "the paper's Eq. 7")
    measured, far = row(text, "measured")
    # 40 mm of water raise a bottom by some 11 mm (`fathom theory`); the paper's formula is for the middle line, and a millimetre
    # off beside it; the device cuts its depth to steps of 3 mm.
    assert 10.0 < raised - really < 12.5, (raised, really)
    assert abs(paper - raised) < 1.0 and near < depth and abs(far - near) < 3.1, (paper, raised, near, depth, far)
    assert "each once on its way" in text
    # A pixel of the desk, by the address; its rays are straight.
    desk = dom(page, folder / "profile", "#pixel=100,400&kind=true&view=above")
    assert 'data-pixel="100,400"' in desk and "Both rays are straight" in desk
    assert abs(row(desk, "true")[0]) < 0.1, "the desk is at height 0"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as name:
        check(str(Path(sys.argv[1]).resolve()), Path(name))
