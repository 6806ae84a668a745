#include "tests/optics/adding_doubling.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace fathom::reference {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// P_0 … P_{count-1} at x.
std::vector<double> legendre(double x, int count) {
  std::vector<double> p{1.0, x};
  for (int l = 2; l < count; ++l) p.push_back(((2 * l - 1) * x * p[l - 1] - (l - 1) * p[l - 2]) / l);
  return p;
}

struct Nodes {
  std::vector<double> mu, weight;
};

/// Adds Gauss–Legendre nodes on [low, high]. Golub & Welsch 1969: eigenvalues of the Jacobi matrix.
void add_gauss(int count, double low, double high, Nodes& nodes) {
  Matrix jacobi = Matrix::Zero(count, count);
  for (int i = 1; i < count; ++i) jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4.0 * i * i - 1.0);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(jacobi);
  for (int i = 0; i < count; ++i) {
    const double v = solver.eigenvectors()(0, i);
    nodes.mu.push_back(0.5 * (low + high) + 0.5 * (high - low) * solver.eigenvalues()(i));
    nodes.weight.push_back(v * v * (high - low));
  }
}

/// Fresnel reflectance from inside at cosine mu, n against 1: ½ (tan²(a−b)/tan²(a+b) + sin²(a−b)/sin²(a+b)).
double fresnel_inside(double mu, double n) {
  const double a = std::acos(std::min(mu, 1.0)), sine = n * std::sin(a);
  if (sine >= 1.0) return 1.0;
  const double b = std::asin(sine);
  if (a + b < 1e-6) return (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
  const double s = std::sin(a - b) / std::sin(a + b), p = std::tan(a - b) / std::tan(a + b);
  return 0.5 * (s * s + p * p);
}

/// What a layer does to the power in each direction: entry (i, j) is the power in direction i per power that arrives in
/// direction j. The beam is a direction of its own, into which nothing is scattered.
struct Response {
  Matrix reflection, transmission;
};

/// A layer so thin that light scatters in it once at most.
Response thin_layer(const Nodes& nodes, double albedo, double thickness, double g, int terms) {
  const int count = static_cast<int>(nodes.mu.size());
  std::vector<std::vector<double>> p;
  for (const double mu : nodes.mu) p.push_back(legendre(mu, terms));
  const double cut = std::pow(g, terms);
  Response layer{Matrix::Zero(count, count), Matrix::Zero(count, count)};
  for (int j = 0; j < count; ++j) {
    const double path = thickness / nodes.mu[j];
    const double scattered = -albedo * std::expm1(-path);
    for (int i = 0; i < count; ++i) {
      double forward = 0.0, backward = 0.0;  // phase function averaged over azimuth, normalised to ∫ dμ over both = 1
      for (int l = 0; l < terms; ++l) {
        const double term = 0.5 * (2 * l + 1) * (std::pow(g, l) - cut) / (1.0 - cut) * p[i][l] * p[j][l];
        forward += term;
        backward += l % 2 == 0 ? term : -term;
      }
      layer.transmission(i, j) = scattered * forward * nodes.weight[i];
      layer.reflection(i, j) = scattered * backward * nodes.weight[i];
    }
    layer.transmission(j, j) += std::exp(-path);
  }
  return layer;
}

Response doubled(const Response& layer) {
  const Matrix one = Matrix::Identity(layer.reflection.rows(), layer.reflection.cols());
  const Matrix between = (one - layer.reflection * layer.reflection).partialPivLu().solve(layer.transmission);
  return {layer.reflection + layer.transmission * layer.reflection * between, layer.transmission * between};
}

}  // namespace

SlabLight adding_doubling(const Slab& slab, double cos_incidence, int angles) {
  const double cos_beam = std::sqrt(1.0 - (1.0 - cos_incidence * cos_incidence) / (slab.n * slab.n));
  Nodes nodes;
  if (slab.n > 1.0) {  // the integrand bends at the critical angle
    const double critical = std::sqrt(1.0 - 1.0 / (slab.n * slab.n));
    add_gauss(angles / 2, 0.0, critical, nodes);
    add_gauss(angles - angles / 2, critical, 1.0, nodes);
  } else {
    add_gauss(angles, 0.0, 1.0, nodes);
  }
  nodes.mu.push_back(cos_beam);
  nodes.weight.push_back(0.0);

  // Legendre terms that the rule integrates exactly with each other.
  const int terms = slab.n > 1.0 ? angles / 2 : angles;
  const double cut = std::pow(slab.g, terms);
  const double albedo = slab.albedo * (1.0 - cut) / (1.0 - slab.albedo * cut);
  double thickness = slab.thickness * (1.0 - slab.albedo * cut);
  int doublings = 0;
  for (; thickness > 1e-7; ++doublings) thickness *= 0.5;
  Response layer = thin_layer(nodes, albedo, thickness, slab.g, terms);
  for (; doublings > 0; --doublings) layer = doubled(layer);

  // Between the two surfaces: down = beam + F up, up = R down + T returned, returned = F (T down + R returned).
  const int count = static_cast<int>(nodes.mu.size());
  Vector inside(count);
  for (int i = 0; i < count; ++i) inside[i] = fresnel_inside(nodes.mu[i], slab.n);
  Vector beam = Vector::Zero(2 * count);
  beam[count - 1] = 1.0 - inside[count - 1];
  Matrix system(2 * count, 2 * count);
  system << layer.reflection, layer.transmission, layer.transmission, layer.reflection;
  system = Matrix::Identity(2 * count, 2 * count) - inside.replicate(2, 1).asDiagonal() * system;
  const Vector light = system.partialPivLu().solve(beam);
  const Vector down = light.head(count), returned = light.tail(count);
  const Vector through = Vector::Ones(count) - inside;
  return {inside[count - 1] + through.dot(layer.reflection * down + layer.transmission * returned),
          through.dot(layer.transmission * down + layer.reflection * returned)};
}

}  // namespace fathom::reference
