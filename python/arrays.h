// NumPy arrays over the program's own memory: nothing is copied, and the memory lives as long as an array looks at it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <utility>
#include <vector>

#include "core/cloud_file.h"
#include "core/image.h"

namespace fathom {

namespace py = pybind11;

/// Keeps `content` until the last array that has it as its base is gone. `kept` is where it lies now.
template <class T>
py::capsule keep(T&& content, T*& kept) {
  kept = new T(std::move(content));
  return py::capsule(kept, [](void* memory) { delete static_cast<T*>(memory); });
}

/// h × w
template <class T>
py::array_t<T> array_of(Image<T>&& image) {
  Image<T>* kept = nullptr;
  const py::capsule owner = keep(std::move(image), kept);
  return py::array_t<T>({kept->height(), kept->width()}, kept->pixels().data(), owner);
}

/// n
template <class T>
py::array_t<T> array_of(std::vector<T>&& numbers) {
  std::vector<T>* kept = nullptr;
  const py::capsule owner = keep(std::move(numbers), kept);
  return py::array_t<T>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

/// Coordinates h × w × 3 and intensities h × w of the same points.
struct CloudArrays {
  py::array_t<float> points, intensity;
};
inline CloudArrays arrays_of(Image<CloudPoint>&& cloud) {
  Image<CloudPoint>* kept = nullptr;
  const py::capsule owner = keep(std::move(cloud), kept);
  const py::ssize_t height = kept->height(), width = kept->width(), point = sizeof(CloudPoint), number = sizeof(float);
  float* first = kept->empty() ? nullptr : &kept->pixels().front().x;
  float* intensity = kept->empty() ? nullptr : &kept->pixels().front().intensity;
  return {py::array_t<float>({height, width, py::ssize_t{3}}, {width * point, point, number}, first, owner),
          py::array_t<float>({height, width}, {width * point, point}, intensity, owner)};
}

}  // namespace fathom
