#!/usr/bin/python3
"""usage: examples/segment_cups.py train DATA_SET NETWORK
       examples/segment_cups.py test NETWORK CLOUD.pcd...
Trains a small network on frames of `fathom generate` alone to say which pixels of a depth image are cups, and tries it on
measured clouds. Clouds of 640 x 480 points with a field `label` are scored where the file LABELS, cups_groundtruth.csv
beside them, says which labels are what. Needs Debian's python3-torch, python3-numpy and python3-opencv.

    fathom generate examples/segment_cups.json --frames 800 -o out/cups
    examples/segment_cups.py train out/cups out/cups.pt
    examples/segment_cups.py test out/cups.pt mOSD/*.pcd"""
import csv
import json
import os
import struct
import sys
import time
from pathlib import Path

import cv2
import numpy as np
import torch
from torch import nn

SIZE = (160, 120)  # of what the network sees
EPOCHS, BATCH, SEED = 8, 8, 1
SURE = 0.5
FEWEST = 40  # pixels at SIZE that are taken for a cup


def points_of(depth, matrix):
    rows, columns = np.indices(depth.shape)
    return np.stack([(columns - matrix[0, 2]) / matrix[0, 0] * depth, (rows - matrix[1, 2]) / matrix[1, 1] * depth, depth], axis=-1)


def desk_of(points, random):
    """The plane n x = d with the most points within 6 mm of it; n points to the camera's side."""
    cloud = points[points[..., 2] > 0]
    sample = cloud[random.choice(len(cloud), 1000)]
    best = (0, None, None)
    for _ in range(150):
        a, b, c = sample[random.integers(len(sample), size=3)]
        normal = np.cross(b - a, c - a)
        if np.linalg.norm(normal) < 1e-6:
            continue
        normal /= np.linalg.norm(normal) * (1 if normal @ a < 0 else -1)
        count = np.sum(np.abs(sample @ normal - normal @ a) < 0.006)
        if count > best[0]:
            best = (count, normal, normal @ a)
    return best[1:]


def seen(points, random):
    """What the network sees: height above the desk, whether there is a depth, and how near it is."""
    normal, offset = desk_of(points, random)
    valid = points[..., 2] > 0
    height = np.where(valid, np.clip(points @ normal - offset, -0.03, 0.3), 0.0) * 10
    near = np.where(valid, 1.0 / np.maximum(points[..., 2], 0.3), 0.0)
    channels = [cv2.resize(channel.astype(np.float32), SIZE, interpolation=cv2.INTER_NEAREST) for channel in (height, valid, near)]
    return np.stack(channels)


class Network(nn.Module):
    """A U-Net (Ronneberger et al. 2015) of three levels."""

    def __init__(self):
        super().__init__()
        wide = [3, 12, 24, 48]
        self.down = nn.ModuleList([self.block(wide[i], wide[i + 1]) for i in range(3)])
        self.up = nn.ModuleList([self.block(48 + 24, 24), self.block(24 + 12, 12)])
        self.last = nn.Conv2d(12, 1, 1)

    @staticmethod
    def block(before, after):
        layers = []
        for first in (before, after):
            layers += [nn.Conv2d(first, after, 3, padding=1, bias=False), nn.BatchNorm2d(after), nn.ReLU(inplace=True)]
        return nn.Sequential(*layers)

    def forward(self, image):
        fine = self.down[0](image)
        middle = self.down[1](nn.functional.max_pool2d(fine, 2))
        coarse = self.down[2](nn.functional.max_pool2d(middle, 4))
        middle = self.up[0](torch.cat([nn.functional.interpolate(coarse, scale_factor=4.0), middle], dim=1))
        fine = self.up[1](torch.cat([nn.functional.interpolate(middle, scale_factor=2.0), fine], dim=1))
        return self.last(fine)[:, 0]


def frames_of(data_set, random):
    inputs, targets = [], []
    for scene in sorted(Path(data_set, "train").iterdir()):
        cameras, cups = (json.loads((scene / f"scene_{name}.json").read_text()) for name in ("camera", "cups"))
        for image in sorted(cameras, key=int):
            depth = cv2.imread(str(scene / f"depth/{int(image):06}.png"), -1) * cameras[image]["depth_scale"] * 1e-3
            mask = np.zeros(depth.shape, np.uint8)
            for cup in cups[image]:
                mask |= cv2.imread(str(scene / f"mask_visib/{int(image):06}_{cup['instance']:06}.png"), -1)
            inputs.append(seen(points_of(depth, np.reshape(cameras[image]["cam_K"], (3, 3))), random))
            targets.append(cv2.resize(mask, SIZE, interpolation=cv2.INTER_NEAREST) > 0)
    return torch.tensor(np.array(inputs)), torch.tensor(np.array(targets), dtype=torch.float32)


def train(data_set, file):
    torch.manual_seed(SEED)
    torch.set_num_threads(os.cpu_count())
    random = np.random.default_rng(SEED)
    inputs, targets = frames_of(data_set, random)
    network = Network()
    optimizer = torch.optim.Adam(network.parameters(), 2e-3)
    steps = EPOCHS * (len(inputs) // BATCH)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, 4e-3, total_steps=steps)
    begin, done = time.monotonic(), 0
    for epoch in range(EPOCHS):
        order = torch.tensor(random.permutation(len(inputs)))
        losses = []
        for start in range(0, len(order) - BATCH + 1, BATCH):
            chosen = order[start:start + BATCH]
            image, target = inputs[chosen], targets[chosen]
            if random.random() < 0.5:
                image, target = image.flip(3), target.flip(2)
            loss = nn.functional.binary_cross_entropy_with_logits(network(image), target, pos_weight=torch.tensor(3.0))
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            schedule.step()
            losses.append(loss.item())
            done += 1
        left = (time.monotonic() - begin) / done * (steps - done)
        print(f"epoch {epoch + 1} of {EPOCHS}: loss {np.mean(losses):.4f}, {left / 60:.1f} min left", flush=True)
    torch.save(network.state_dict(), file)


def unpacked(packed, size):
    """LZF, as PCD files of the kind binary_compressed have it."""
    out, at = bytearray(), 0
    while at < len(packed):
        control = packed[at]
        at += 1
        if control < 32:
            out += packed[at:at + control + 1]
            at += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += packed[at]
            at += 1
        back = len(out) - ((control & 31) << 8) - packed[at] - 1
        at += 1
        for i in range(back, back + length + 2):
            out.append(out[i])
    assert len(out) == size
    return bytes(out)


def cloud_of(file):
    """Points [m] and labels, row by row."""
    data = Path(file).read_bytes()
    head, _, body = data.partition(b"DATA binary_compressed\n")
    if not body or b"FIELDS label x y z" not in head or b"WIDTH 640" not in head:
        sys.exit(f"error: {file}: must be an organised PCD of 640 x 480, binary_compressed, with label x y z")
    packed, size = struct.unpack("<II", body[:8])
    fields = np.frombuffer(unpacked(body[8:8 + packed], size), "<u4").reshape(-1, 480, 640)
    points = np.nan_to_num(np.moveaxis(fields[1:4].view("<f4"), 0, -1).astype(float))
    return points, fields[0]


def test(file, clouds):
    torch.manual_seed(SEED)
    random = np.random.default_rng(SEED)
    network = Network()
    network.load_state_dict(torch.load(file))
    network.eval()
    mugs = found = overlaps = others = false = 0
    for cloud in clouds:
        points, labels = cloud_of(cloud)
        with torch.no_grad():
            chance = torch.sigmoid(network(torch.tensor(seen(points, random))[None]))[0].numpy()
        count, parts, stats, _ = cv2.connectedComponentsWithStats((chance > SURE).astype(np.uint8))
        parts_found = [part for part in range(1, count) if stats[part, cv2.CC_STAT_AREA] >= FEWEST]
        small = cv2.resize(labels.astype(np.float32), SIZE, interpolation=cv2.INTER_NEAREST).astype(int)
        taken = set()
        for row in csv.DictReader(open(Path(cloud).parent / "cups_groundtruth.csv")):
            if row["scene"] != Path(cloud).stem:
                continue
            mask = np.isin(small, [int(label) for label in row["labels"].split("/")])
            best = max(parts_found, key=lambda part: np.sum(mask & (parts == part)), default=0)
            overlap = np.sum(mask & (parts == best)) / np.sum(mask | (parts == best)) if best else 0.0
            if row["object"] == "mug_upright":
                mugs, found = mugs + 1, found + (overlap > 0.5)
                overlaps += overlap
                if overlap > 0.5:
                    taken.add(best)
            else:
                others += 1
            print(f"{row['scene']:10} {row['object']:14} intersection over union {overlap:.2f}")
        false += len(set(parts_found) - taken)
    print(f"mugs found {found}/{mugs}, mean intersection over union {overlaps / max(mugs, 1):.2f}, other vessels {others}, false {false}")


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "train":
        train(sys.argv[2], sys.argv[3])
    elif len(sys.argv) >= 4 and sys.argv[1] == "test":
        test(sys.argv[2], sys.argv[3:])
    else:
        sys.exit(__doc__)
