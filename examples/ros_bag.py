#!/usr/bin/python3
"""usage: examples/ros_bag.py BAG CAPTURE...
Writes folders of `fathom capture`, in their order, into a bag of ROS 1, 30 frames a second, with the topics of openni2_camera:
/camera/depth/image_raw, /camera/ir/image_raw, the camera_info of both, and /tf_static from `world` to the camera's optical frame.
Needs Debian's python3-rosbag, python3-sensor-msgs, python3-tf2-msgs and python3-numpy."""
import json
import sys
from pathlib import Path

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

FRAME = "camera_depth_optical_frame"


def read_cloud(path):
    """rows × columns × 4 of Fathom's own PCD files: x, y, z [m], intensity."""
    header, data = path.read_bytes().split(b"DATA binary\n", 1)
    facts = dict(line.split(" ", 1) for line in header.decode().splitlines() if " " in line)
    return np.frombuffer(data, "<f4").reshape(int(facts["HEIGHT"]), int(facts["WIDTH"]), 4)


def image(values, encoding, stamp):
    message = Image(height=values.shape[0], width=values.shape[1], encoding=encoding, step=2 * values.shape[1], data=values.tobytes())
    message.header.stamp, message.header.frame_id = stamp, FRAME
    return message


def camera_info(matrix, shape, stamp):
    """ROS has the first pixel's centre at (0, 0), Fathom at (0.5, 0.5)."""
    k = np.array(matrix)
    k[:2, 2] -= 0.5
    message = CameraInfo(height=shape[0], width=shape[1], distortion_model="plumb_bob", D=[0.0] * 5, K=k.ravel().tolist(),
                         R=np.eye(3).ravel().tolist(), P=np.hstack([k, np.zeros((3, 1))]).ravel().tolist())
    message.header.stamp, message.header.frame_id = stamp, FRAME
    return message


def pose(world_from_camera, stamp):
    message = TransformStamped(child_frame_id=FRAME)
    message.header.stamp, message.header.frame_id = stamp, "world"
    rotation = np.array(world_from_camera)[:3, :3]
    # The quaternion is the eigenvector of the largest eigenvalue (Bar-Itzhack).
    (a, b, c), (d, e, f), (g, h, i) = rotation
    values, vectors = np.linalg.eigh([[a - e - i, b + d, c + g, h - f], [b + d, e - a - i, f + h, c - g],
                                      [c + g, f + h, i - a - e, d - b], [h - f, c - g, d - b, a + e + i]])
    for target, names, numbers in ((message.transform.translation, "xyz", np.array(world_from_camera)[:3, 3]),
                                   (message.transform.rotation, "xyzw", vectors[:, -1])):
        for name, number in zip(names, numbers):
            setattr(target, name, float(number))
    return TFMessage([message])


def frames(folder):
    """The folder of each frame: a capture has one, or many below it."""
    return sorted(folder.glob("frame_*")) or [folder]


def main(bag, captures):
    with rosbag.Bag(bag, "w") as file:
        number = 0
        for capture in captures:
            record = json.loads((capture / "run.json").read_text())
            for folder in frames(capture):
                stamp = rospy.Time.from_sec(1 + number / 30)
                cloud = read_cloud(folder / "cloud.pcd")
                depth_mm = np.nan_to_num(np.rint(1000 * cloud[..., 2])).astype("<u2")
                info = camera_info(record["camera_matrix"], depth_mm.shape, stamp)
                if number == 0:
                    file.write("/tf_static", pose(record["world_from_camera"], stamp), stamp)
                file.write("/camera/depth/image_raw", image(depth_mm, "16UC1", stamp), stamp)
                file.write("/camera/depth/camera_info", info, stamp)
                file.write("/camera/ir/image_raw", image(np.rint(cloud[..., 3]).astype("<u2"), "mono16", stamp), stamp)
                file.write("/camera/ir/camera_info", info, stamp)
                number += 1
    print(f"{bag}: {number} frames")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], [Path(name) for name in sys.argv[2:]])
