#!/usr/bin/python3
"""usage: examples/record_clouds.py DIR [--clouds N] [--interval-s S] [--device URI]
Records clouds of an Xtion, or of another device that OpenNI2 knows, for `fathom calibrate`, `detect` and measurement directories:
DIR/cloud_0000.pcd and so on, in metres in the camera's frame, and DIR/frames.csv with the column time_s, the seconds since the
start. Needs Debian's libopenni2-0 and python3-numpy."""
import argparse
import ctypes
import sys
import time
from ctypes import POINTER, byref, c_char_p, c_float, c_int, c_uint64, c_void_p
from pathlib import Path

import numpy as np

API_VERSION, OK = 2002, 0
DEPTH_SENSOR = 3
HORIZONTAL_FIELD_OF_VIEW, VIDEO_MODE, MIRRORING = 1, 3, 7
DEPTH_1_MM = 100
PATIENCE_MS = 10000


class VideoMode(ctypes.Structure):
    _fields_ = [("format", c_int), ("columns", c_int), ("rows", c_int), ("rate", c_int)]


class Frame(ctypes.Structure):
    _fields_ = [("size", c_int), ("data", c_void_p), ("sensor", c_int), ("timestamp", c_uint64), ("index", c_int), ("width", c_int),
                ("height", c_int), ("mode", VideoMode), ("cropped", c_int), ("left", c_int), ("top", c_int), ("stride", c_int)]


class Camera:
    def __init__(self, uri):
        try:
            self.library = ctypes.CDLL("libOpenNI2.so.0")
        except OSError as error:
            sys.exit(f"error: {error}; install libopenni2-0")
        self.library.oniGetExtendedError.restype = c_char_p
        self.name = uri or "OpenNI2"
        self.require(self.library.oniInitialize(API_VERSION))
        device, self.stream = c_void_p(), c_void_p()
        self.require(self.library.oniDeviceOpen(uri.encode() if uri else None, byref(device)))
        self.require(self.library.oniDeviceCreateStream(device, DEPTH_SENSOR, byref(self.stream)))
        self.set(VIDEO_MODE, VideoMode(DEPTH_1_MM, 640, 480, 30))
        self.set(MIRRORING, c_int(0))  # a real one starts mirrored
        angle, size = c_float(), c_int(ctypes.sizeof(c_float))
        self.require(self.library.oniStreamGetProperty(self.stream, HORIZONTAL_FIELD_OF_VIEW, byref(angle), byref(size)))
        self.focal_px = 320 / np.tan(angle.value / 2)
        self.require(self.library.oniStreamStart(self.stream))

    def require(self, status):
        if status != OK:
            why = " ".join((self.library.oniGetExtendedError() or b"").decode(errors="replace").split())
            sys.exit(f"error: {self.name}: {why or 'no device, or no depth from it'}")

    def set(self, setting, value):
        self.require(self.library.oniStreamSetProperty(self.stream, setting, byref(value), ctypes.sizeof(value)))

    def depth_mm(self):
        """The next frame, of those that are not read yet the latest."""
        streams, ready, frame = (c_void_p * 1)(self.stream), c_int(), POINTER(Frame)()
        self.require(self.library.oniWaitForAnyStream(streams, 1, byref(ready), PATIENCE_MS))
        self.require(self.library.oniStreamReadFrame(self.stream, byref(frame)))
        facts = frame.contents
        depth = np.frombuffer(ctypes.string_at(facts.data, facts.size), np.uint16).reshape(facts.height, facts.stride // 2)[:, :facts.width]
        self.library.oniFrameRelease(frame)
        return depth

    def points(self):
        """480 × 640 × 3 [m]: x right, y down, z forward; NaN where nothing was measured."""
        depth = np.where((millimetres := self.depth_mm()) > 0, millimetres / 1000, np.nan)
        rows, columns = np.indices(depth.shape)
        return np.stack([(columns + 0.5 - 320) / self.focal_px * depth, (rows + 0.5 - 240) / self.focal_px * depth, depth], axis=-1)


def write_pcd(path, points):
    rows, columns, _ = points.shape
    header = (f"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {columns}\nHEIGHT {rows}\n"
              f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {rows * columns}\nDATA binary\n")
    path.write_bytes(header.encode() + points.astype("<f4").tobytes())


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n")[0].removeprefix("usage: "))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--clouds", type=int, default=10)
    parser.add_argument("--interval-s", type=float, default=1)
    parser.add_argument("--device")
    options = parser.parse_args()
    camera = Camera(options.device)
    options.folder.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    lines = ["cloud,time_s"]
    for number in range(options.clouds):
        time.sleep(max(0, start + number * options.interval_s - time.monotonic()))
        points = camera.points()
        name = f"cloud_{number:04}.pcd"
        lines.append(f"{name},{time.monotonic() - start:.1f}")
        write_pcd(options.folder / name, points)
        print(f"{options.folder / name}: {np.isfinite(points[..., 2]).mean():.0%} of the pixels have a depth")
    (options.folder / "frames.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
