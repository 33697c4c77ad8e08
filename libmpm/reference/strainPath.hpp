#pragma once
/// Strain as a function of time: harmonic components or a table between whose rows the strain rate is constant.
///
/// A path consists of pieces; the strain rate is smooth inside a piece and may jump between pieces.
#include "constitutive/singlePoint.hpp"

#include <functional>
#include <vector>

namespace mpm::reference
{
using constitutive::SymmetricTensor;

/// A strain rate component amplitude cos(w t) or amplitude sin(w t); w = 0 makes cos a constant rate.
struct Harmonic
{
    double amplitude = 0;        ///< [1/s]
    double angularFrequency = 0; ///< w [rad/s]
    bool sine = false;

    double rate(double t) const;
    double integral(double t) const; ///< strain from 0 to t
};

/// A tensor turned by an angle about z: Q T Q^T.
SymmetricTensor turned(const SymmetricTensor& tensor, double angle);

class StrainPath
{
  public:
    /// One piece from t = 0 to `end` with the rates of the six components.
    static StrainPath harmonic(const std::array<Harmonic, 6>& components, double end);
    /// The same with the rates of axes that turn about z at `spin` [rad/s] as the material sees them (a step with the
    /// velocity gradient D + W sees its strain rate turn by the angle -w t, w the spin of W).
    static StrainPath turning(const std::array<Harmonic, 6>& components, double spin, double end);
    /// Straight pieces between rows; times must grow. Throws InputError otherwise, or for fewer than two rows.
    static StrainPath table(std::vector<double> times, std::vector<SymmetricTensor> strains);

    /// Where pieces begin, and the end of the last.
    const std::vector<double>& breaks() const { return breaks_; }
    std::size_t pieces() const { return breaks_.size() - 1; }
    double begin() const { return breaks_.front(); }
    double end() const { return breaks_.back(); }

    /// Pieces on which the strain rate is constant.
    bool straight() const { return straight_; }

    SymmetricTensor rate(std::size_t piece, double t) const { return rate_(piece, t); }
    /// Strain between two times of one piece.
    SymmetricTensor increment(std::size_t piece, double from, double to) const { return increment_(piece, from, to); }

    /// Spin of the axes of the given rates, and the strain between two times as seen in them.
    double spin() const { return spin_; }
    SymmetricTensor incrementInAxes(double from, double to) const { return inAxes_(from, to); }

  private:
    StrainPath() = default;
    double spin_ = 0;
    std::function<SymmetricTensor(double, double)> inAxes_;
    std::vector<double> breaks_;
    bool straight_ = false;
    std::function<SymmetricTensor(std::size_t, double)> rate_;
    std::function<SymmetricTensor(std::size_t, double, double)> increment_;
};
} // namespace mpm::reference
