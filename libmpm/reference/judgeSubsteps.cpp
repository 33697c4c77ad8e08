#include "base/clock.hpp"
#include "reference/rateEquations.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::reference
{
namespace
{
double norm(const SymmetricTensor& s)
{
    double sum = 0;
    for (const double x : s)
        sum += x * x;
    return std::sqrt(sum);
}

double distance(const SymmetricTensor& a, const SymmetricTensor& b)
{
    SymmetricTensor d;
    for (int k = 0; k < 6; ++k)
        d[k] = a[k] - b[k];
    return norm(d);
}

/// One step of the time step's kind: the stress is turned by all of the rotation, then the law adds the strain.
class Point
{
  public:
    explicit Point(const SymmetricTensor& stress) : stress_(stress) {}

    void step(const constitutive::Law& law, const SymmetricTensor& dStrain, double angle)
    {
        // W with the spin that Cayley's rotation over dt = 1 turns into this angle
        const double w = 2 * std::tan(0.5 * angle);
        for (int k = 0; k < 9; ++k)
            std::fill_n(L_[k], lanes, k == 3 ? w : k == 1 ? -w : 0.0);
        chunk_.count = 1;
        chunk_.L = &L_;
        chunk_.dt = 1;
        for (int k = 0; k < 6; ++k)
        {
            std::fill_n(chunk_.stress[k], lanes, stress_[k]);
            std::fill_n(chunk_.dStrain[k], lanes, dStrain[k]);
        }
        constitutive::rotateStress(L_, 1, chunk_.stress);
        law.update(chunk_);
        for (int k = 0; k < 6; ++k)
            stress_[k] = chunk_.stress[k][0];
    }

    const SymmetricTensor& stress() const { return stress_; }
    const constitutive::Chunk<3>& chunk() const { return chunk_; }

  private:
    SymmetricTensor stress_;
    constitutive::Chunk<3> chunk_;
    alignas(64) constitutive::TensorLanes<3> L_;
};
} // namespace

std::vector<SubstepError> judgeSubsteps(const constitutive::Law& law, const constitutive::Law& plain,
                                        const SymmetricTensor& start, const StrainPath& path, const RateSolution& exact,
                                        const std::vector<int>& steps)
{
    double size = 0;
    for (const auto& s : exact.stress)
        size = std::max(size, norm(s));
    const double last = norm(exact.stress.back());
    const auto run = [&](const constitutive::Law& which, int n, SubstepError* row) {
        Point point(start);
        double calls = 0;
        for (std::size_t piece = 0; piece < path.pieces(); ++piece)
        {
            const double from = path.breaks()[piece], length = path.breaks()[piece + 1] - from;
            for (int i = 0; i < n; ++i)
            {
                const double t0 = from + length * i / n, t1 = from + length * (i + 1) / n;
                // in the axes of the rates the material turns the other way
                if (path.spin() != 0)
                    point.step(which, path.incrementInAxes(t0, t1), -path.spin() * (t1 - t0));
                else
                    point.step(which, path.increment(piece, t0, t1), 0);
                calls += point.chunk().parts;
            }
            if (row)
                row->largest =
                    std::max(row->largest, distance(turned(point.stress(), path.spin() * path.breaks()[piece + 1]),
                                                    exact.stress[piece + 1]));
        }
        if (!row)
            return;
        row->stress = turned(point.stress(), path.spin() * path.end());
        row->yield = point.chunk().yield[0];
        row->calls = calls / double(n * int(path.pieces()));
    };
    const auto seconds = [&](const constitutive::Law& which, int n) {
        double best = 1e300;
        for (int repeat = 0; repeat < 3; ++repeat)
        {
            const double begin = now();
            run(which, n, nullptr);
            best = std::min(best, now() - begin);
        }
        return best;
    };
    std::vector<SubstepError> out;
    for (const int n : steps)
    {
        SubstepError row{n, 0, 0, 0, 0, 0, {}};
        run(law, n, &row);
        row.final = distance(row.stress, exact.stress.back()) / (last > 0 ? last : size > 0 ? size : 1);
        row.largest /= size > 0 ? size : 1;
        row.time = seconds(law, n) / std::max(seconds(plain, n), 1e-12);
        out.push_back(row);
    }
    return out;
}
} // namespace mpm::reference
