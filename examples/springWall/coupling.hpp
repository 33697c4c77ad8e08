#pragma once
/// Wall and soil, window by window. The wall (mpm::reference::SpringWall) is pushed by the mean force of a window, the
/// soil meets the wall where it is at the window's end.
///
/// explicit   the wall goes first, with the force of the window before; then the soil. Once each.
///            The force is a window late: first order, and unstable for a wall that is light against the soil it must
///            take along in a window (P. Causin, J. F. Gerbeau & F. Nobile 2005, Comput. Methods Appl. Mech. Eng. 194:
///            the added mass).
/// implicit   x -> soil -> F -> wall -> x~ is repeated from the window's start until x~ = x to `tolerance`:
///                x <- x + omega r,   r = x~ - x,   omega <- -omega r_old/(r - r_old)
///            (Aitken; U. Kuettler & W. A. Wall 2008, Comput. Mech. 43, 61-72, Eq. 44). For one freedom this is the
///            secant method, and the interface quasi-Newton method with one column is the same. Soil pushes and does
///            not pull, so r has kinks: x is kept between places where r has different signs, halving where Aitken
///            leads out.
#include "reference/springWall.hpp"
#include "soilSide.hpp"

#include <functional>

namespace springWall
{
struct Scheme
{
    bool implicitly = true;
    double window = 0.01;     ///< [s]
    double tolerance = 1e-10; ///< [m]
    int mostIterations = 40;
    double firstRelaxation = 0.05; ///< omega of the very first iteration
};

struct Row
{
    double time, force; ///< [s], mean force on the wall [N/m]
    double soilWork;    ///< of the wall on the soil since the start [J/m]
    double soilImpulse; ///< of the soil on the wall since the start, as the soil counts it [N s/m]
    double wallImpulse; ///< as the wall got it
    double mismatch;    ///< |x~ - x| in the end [m]
    int iterations;
};

class Coupling
{
  public:
    Coupling(SoilSide& soil, mpm::reference::SpringWall& wall, const Scheme& scheme)
        : soil_(soil), wall_(wall), scheme_(scheme), omega_(scheme.firstRelaxation)
    {}
    /// Windows until `end`; `tell` after each. SoilLost when the soil cannot follow or iterations do not converge.
    void run(double end, const std::function<void(const Row&)>& tell);

  private:
    void explicitWindow(double window, Row& row);
    void implicitWindow(double window, Row& row);

    SoilSide& soil_;
    mpm::reference::SpringWall& wall_;
    Scheme scheme_;
    double omega_;
    double force_ = 0; ///< of the last window
};
} // namespace springWall
