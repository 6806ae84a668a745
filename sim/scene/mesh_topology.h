// How the triangles of a mesh hang together, whatever vertices they repeat: files repeat one for each of its normals.
#pragma once

#include <vector>

#include "sim/scene/mesh.h"

namespace fathom {

/// Whether the triangles enclose a volume and face out of it: each edge is passed in both directions equally often.
/// Vertices are the same where their coordinates are, bit for bit.
bool encloses_volume(const Mesh& mesh);

/// For each triangle the number of its patch: triangles that are joined by edges which two of them share, and no third.
std::vector<int> patches(const Mesh& mesh);

}  // namespace fathom
