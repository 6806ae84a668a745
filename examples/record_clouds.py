#!/usr/bin/python3
"""usage: examples/record_clouds.py DIR [--clouds N] [--interval-s S] [--device URI]
Records clouds of an Xtion, or of another device that OpenNI2 knows, for `fathom calibrate`, `detect` and measurement directories:
DIR/cloud_0000.pcd and so on, in metres in the camera's frame, with the infrared brightness of each point if the device gives it,
and DIR/frames.csv with the column time_s, the seconds since the start. Needs Debian's libopenni2-0 and python3-numpy."""
import argparse
import ctypes
import sys
import time
from contextlib import closing
from ctypes import POINTER, byref, c_char_p, c_float, c_int, c_uint64, c_void_p
from pathlib import Path

import numpy as np

API_VERSION, OK = 2002, 0
INFRARED_SENSOR, DEPTH_SENSOR = 1, 3
HORIZONTAL_FIELD_OF_VIEW, VIDEO_MODE, MIRRORING = 1, 3, 7
DEPTH_1_MM, GRAY_16 = 100, 203
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
            raise OSError(f"{error}; install libopenni2-0")
        self.library.oniGetExtendedError.restype = c_char_p
        self.require(self.library.oniInitialize(API_VERSION))
        self.device = c_void_p()
        self.require(self.library.oniDeviceOpen(uri.encode() if uri else None, byref(self.device)))
        self.depth = self.start(DEPTH_SENSOR, DEPTH_1_MM)
        try:
            self.infrared = self.start(INFRARED_SENSOR, GRAY_16)
        except OSError:  # not every device has it beside depth
            self.infrared = None
        angle, size = c_float(), c_int(ctypes.sizeof(c_float))
        self.require(self.library.oniStreamGetProperty(self.depth, HORIZONTAL_FIELD_OF_VIEW, byref(angle), byref(size)))
        self.focal_px = 320 / np.tan(angle.value / 2)

    def close(self):
        for stream in filter(None, [self.depth, self.infrared]):
            self.library.oniStreamStop(stream)
            self.library.oniStreamDestroy(stream)
        self.library.oniDeviceClose(self.device)
        self.library.oniShutdown()

    def require(self, status):
        if status != OK:
            why = " ".join((self.library.oniGetExtendedError() or b"").decode(errors="replace").split())
            raise OSError(why or "no device, or no depth from it")

    def start(self, sensor, pixels):
        """A stream of 480 × 640 pixels that runs."""
        stream = c_void_p()
        self.require(self.library.oniDeviceCreateStream(self.device, sensor, byref(stream)))
        mode, mirrored = VideoMode(pixels, 640, 480, 30), c_int(0)  # a real one starts mirrored
        for name, value in [(VIDEO_MODE, mode), (MIRRORING, mirrored)]:
            self.require(self.library.oniStreamSetProperty(stream, name, byref(value), ctypes.sizeof(value)))
        self.require(self.library.oniStreamStart(stream))
        return stream

    def image(self, stream):
        """The next frame, of those that are not read yet the latest."""
        streams, ready, frame = (c_void_p * 1)(stream), c_int(), POINTER(Frame)()
        self.require(self.library.oniWaitForAnyStream(streams, 1, byref(ready), PATIENCE_MS))
        self.require(self.library.oniStreamReadFrame(stream, byref(frame)))
        facts = frame.contents
        image = np.frombuffer(ctypes.string_at(facts.data, facts.size), np.uint16).reshape(facts.height, facts.stride // 2)[:, :facts.width]
        self.library.oniFrameRelease(frame)
        return image

    def cloud(self):
        """480 × 640 × 4: x right, y down, z forward [m], NaN where nothing was measured; infrared brightness, if there is any."""
        millimetres = self.image(self.depth)
        depth = np.where(millimetres > 0, millimetres / 1000, np.nan)
        rows, columns = np.indices(depth.shape)
        values = [(columns + 0.5 - 320) / self.focal_px * depth, (rows + 0.5 - 240) / self.focal_px * depth, depth]
        if self.infrared:
            values.append(self.image(self.infrared))
        return np.stack(values, axis=-1)


def write_pcd(path, cloud):
    rows, columns, number = cloud.shape
    fields = ["x", "y", "z", "intensity"][:number]
    header = (f"VERSION 0.7\nFIELDS {' '.join(fields)}\nSIZE{' 4' * number}\nTYPE{' F' * number}\nCOUNT{' 1' * number}\n"
              f"WIDTH {columns}\nHEIGHT {rows}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {rows * columns}\nDATA binary\n")
    path.write_bytes(header.encode() + cloud.astype("<f4").tobytes())


def record(camera, options):
    options.folder.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    lines = ["cloud,time_s"]
    for number in range(options.clouds):
        time.sleep(max(0, start + number * options.interval_s - time.monotonic()))
        cloud = camera.cloud()
        name = f"cloud_{number:04}.pcd"
        lines.append(f"{name},{time.monotonic() - start:.1f}")
        write_pcd(options.folder / name, cloud)
        with_infrared = ", all an infrared brightness" if camera.infrared else ""
        print(f"{options.folder / name}: {np.isfinite(cloud[..., 2]).mean():.0%} of the pixels have a depth{with_infrared}")
    (options.folder / "frames.csv").write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n")[0].removeprefix("usage: "))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--clouds", type=int, default=10)
    parser.add_argument("--interval-s", type=float, default=1)
    parser.add_argument("--device")
    options = parser.parse_args()
    try:
        with closing(Camera(options.device)) as camera:
            record(camera, options)
    except OSError as error:
        sys.exit(f"error: {error}")


if __name__ == "__main__":
    main()
