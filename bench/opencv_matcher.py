"""Clouds of a photometric campaign as another device would have made them: its infrared images, matched by OpenCV.

cv2.StereoBM compares each image with one of a wall at the reference distance, which the same pattern was thrown on. The
device's steps come after. Nothing is shared with blind/povray, which matches by OpenCV as well: that world judges what is
learned here. Needs NumPy and OpenCV (Debian: python3-opencv).
"""
import csv, json
import cv2
import numpy as np

COLUMNS, ROWS = 640, 480
STEPS_PER_PX, HALF_STEP = 8, 0.5
SEARCH_IR_PX = (-32, 192)  # least disparity and how many: from 2 m to 0.4 m


def infrared(file):
    """(960, 1280) of 8 bits: what lies on the depth image. Counts have 10 bits; images for people have 8."""
    image = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    if image is None:
        raise SystemExit(f"error: {file}: is no image")
    image = np.clip(image / 4, 0, 255).astype(np.uint8) if image.dtype == np.uint16 else image
    edge = (image.shape[0] - 2 * ROWS) // 2
    return image[edge:edge + 2 * ROWS]


def disparity_px(image, reference, window_px):
    """(480, 640), of the depth image; NaN where OpenCV finds none. `window_px` is of the depth image, too."""
    matcher = cv2.StereoBM_create(numDisparities=SEARCH_IR_PX[1], blockSize=2 * window_px + 1)
    matcher.setMinDisparity(SEARCH_IR_PX[0])
    matcher.setPreFilterType(cv2.STEREO_BM_PREFILTER_XSOBEL)
    matcher.setUniquenessRatio(12)
    matcher.setSpeckleWindowSize(120)
    matcher.setSpeckleRange(2)
    room = sum(SEARCH_IR_PX) + 2 * window_px + 1  # at the left, for the search
    wide = [cv2.copyMakeBorder(each, 0, 0, room, room, cv2.BORDER_CONSTANT, value=0) for each in (image, reference)]
    found = matcher.compute(*wide)[:, room:-room] / 16
    found[found < SEARCH_IR_PX[0]] = np.nan
    return (found[0::2, 0::2] + found[1::2, 1::2]) / 4  # two pixels' mean, half as many pixels


def match_again(campaign, reference_image, reference_mm, window_px):
    """Overwrites the clouds of a campaign that holds infrared images."""
    rig = json.loads((campaign / "rig.json").read_text())["sensor"]
    focal_px, baseline_mm = rig["focal_px"], rig["baseline_mm"]
    row, column = np.mgrid[0:ROWS, 0:COLUMNS]
    reference = infrared(reference_image)
    with open(campaign / "frames.csv", newline="") as lines:
        frames = list(csv.DictReader(lines))
    for frame in frames:
        steps = np.round(STEPS_PER_PX * disparity_px(infrared(campaign / frame["ir"]), reference, window_px)) + HALF_STEP
        depth = np.floor(1 / (1 / reference_mm + steps / (STEPS_PER_PX * focal_px * baseline_mm))) * 1e-3
        file = campaign / frame["cloud"]
        head, _, body = file.read_bytes().partition(b"DATA binary\n")
        cloud = np.frombuffer(body, "<f4").reshape(ROWS, COLUMNS, 4).copy()
        cloud[..., 0] = (column - (COLUMNS - 1) / 2) * depth / focal_px
        cloud[..., 1] = (row - (ROWS - 1) / 2) * depth / focal_px
        cloud[..., 2] = depth
        file.write_bytes(head + b"DATA binary\n" + cloud.tobytes())
