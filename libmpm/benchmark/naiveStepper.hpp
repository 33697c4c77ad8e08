#pragma once
/// The step as one would write it first: an array of particle structures, plain loops over particle-node pairs, each
/// pair with weights of its own, nodes in one dense box, particles in the order they came, one thread. It is what the
/// step of stepping/ is measured and checked against; nothing of transfer/, shape/, nodal/ or stepping/ is used.
///
/// METHOD's equations: m_i = sum m N, v_i = sum m v N/m_i, f_i = - sum V sigma gradN + m_i g, walls (fixed, roller,
/// friction) on u = v_i + dt f_i/m_i, v += dt sum N a, x += dt sum N v*, stress by USF, USL or MUSL.
/// Weights: the hat function's antiderivative H, N = (H(d + l) - H(d - l))/(2 l), for both GIMP shapes; the hat itself
/// for linear. Law and kinematics are the library's, for 64 particles at a time: they have references of their own, and
/// one lane at a time would cost 64.
///
/// Left out, and refused: splitting, damping, tractions, prescribed body forces, several materials.
///
/// Verified in tests/verification/naiveStep.cpp: 50 steps of a column agree with makeStepper's to 1e-9.
#include "stepping/stepper.hpp"

#include <memory>
#include <string>

namespace mpm::benchmark
{
class NaiveStepper
{
  public:
    virtual ~NaiveStepper() = default;
    virtual void step(double dt) = 0;
    virtual Index particles() const = 0;
    /// Writes the particles into a state that had them in the beginning, by id.
    virtual void store(state::State& state) const = 0;
};

/// Shapes the naive step has: linear, uGIMP, cpGIMP.
bool naiveKnows(const std::string& shape);

/// shape: linear, uGIMP or cpGIMP. Throws InputError for what the step leaves out.
std::unique_ptr<NaiveStepper> makeNaiveStepper(const std::string& shape, const state::State& state,
                                               const stepping::Scene& scene);
} // namespace mpm::benchmark
