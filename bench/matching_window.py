#!/usr/bin/python3
"""usage: bench/matching_window.py [--blocks 9,15,19,23]
Over how wide a window a block matcher averages disparities: dots are drawn on a surface whose disparity is a parabola of curvature c,
cv2.StereoBM matches them, and a mean over w pixels would be off by c w²/24 at the vertex. Blocks and windows are printed in pixels of
the infrared image, which has twice those of the depth. Shares nothing with blind/povray, which judges what is learned here.
Needs Debian's python3-numpy and python3-opencv."""
import argparse
import cv2
import numpy as np

ROWS, COLUMNS, PERIOD_PX, OFFSET_PX = 960, 1280, 160, 20
DOTS, DOT_SIGMA_PX, WHITE, AMBIENT, SHOT, SPECKLE = 37000, 0.9, 130, 4, 0.35, 0.3  # nine dots in 19 × 19 pixels, as a device has them


def drawn(x, y, levels):
    image, reach = np.zeros((ROWS, COLUMNS)), 4
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            at_x, at_y = column + dx, row + dy
            ok = (at_x >= 0) & (at_x < COLUMNS) & (at_y >= 0) & (at_y < ROWS)
            dots = levels * np.exp(-((at_x - x) ** 2 + (at_y - y) ** 2) / (2 * DOT_SIGMA_PX**2))
            np.add.at(image, (at_y[ok], at_x[ok]), dots[ok])
    return image


def eight_bits(image):
    return np.clip(np.round(image), 0, 255).astype(np.uint8)


def from_vertex(x):
    return x % PERIOD_PX - PERIOD_PX / 2


def bias_px(block, curvature, rng):
    """Mean of what is matched less the true disparity, within 10 px of the vertices."""
    x, y = rng.uniform(0, COLUMNS, DOTS), rng.uniform(0, ROWS, DOTS)
    levels = WHITE * np.exp(0.25 * rng.standard_normal(DOTS))
    seen = x + OFFSET_PX
    for _ in range(60):  # disparity is of where the camera sees a dot
        seen = x + OFFSET_PX + 0.5 * curvature * from_vertex(seen) ** 2
    settled = np.abs(seen - x - OFFSET_PX - 0.5 * curvature * from_vertex(seen) ** 2) < 1e-3
    speckle = rng.gamma(1 / SPECKLE**2, SPECKLE**2, DOTS)
    left = drawn(seen[settled], y[settled], (levels * speckle)[settled]) + AMBIENT
    left += SHOT * np.sqrt(left) * rng.standard_normal(left.shape)
    matcher = cv2.StereoBM_create(numDisparities=64, blockSize=block)
    matcher.setPreFilterType(cv2.STEREO_BM_PREFILTER_XSOBEL)
    matcher.setUniquenessRatio(12)
    found = matcher.compute(eight_bits(left), eight_bits(drawn(x, y, levels) + AMBIENT)).astype(float) / 16
    columns = np.broadcast_to(np.arange(COLUMNS), found.shape)
    u = from_vertex(columns)
    error = (found - OFFSET_PX - 0.5 * curvature * u**2)[(np.abs(u) < 10) & (found > 0) & (columns > 150) & (columns < COLUMNS - 130)]
    return error[np.abs(error) < 2].mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blocks", default="9,15,19,23")
    blocks = [int(block) for block in parser.parse_args().blocks.split(",")]
    print("curvature [1/px]  block [px]  bias [px]  window [px]")
    for curvature in (0.004, 0.008, 0.016):
        for block in blocks:
            rng = np.random.default_rng(1)
            bias = np.mean([bias_px(block, curvature, rng) for _ in range(2)])
            print(f"{curvature:16.3f}  {block:10}  {bias:9.3f}  {(24 * max(bias, 0) / curvature) ** 0.5:11.1f}", flush=True)


if __name__ == "__main__":
    main()
