#pragma once
/// What the wall's master knows of the soil: one window at a time, taken back or accepted. Three ways to it, which give
/// the same numbers bit by bit:
///
///     inProcess    mpm::Participant in this program                         soilInProcess.cpp
///     socket       soilServer, a program in C, at the other end of a        soilBySocket.cpp, soilServer.c
///                  Unix socket
///     fmu          an unpacked FMU of the case (FMI 3.0 Co-Simulation)      soilByFmu.cpp
///
/// The soil's surface is rigid and called `wall`; it moves along x. Its reference point is the origin (`reference (0 0
/// 0);` in system/couplingDict), so that the place of a pose is the wall's displacement.
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace springWall
{
/// The soil, or the way to it, is gone: one line.
class SoilLost : public std::runtime_error
{
    using std::runtime_error::runtime_error;
};

struct SoilWindow
{
    double force = 0; ///< of the soil on the wall along x, mean of the window [N/m]
    double work = 0;  ///< of the wall on the soil since the start [J/m]
};

class SoilSide
{
  public:
    virtual ~SoilSide() = default;
    virtual double time() = 0;
    /// Keeps the state a window starts from, and goes back to it.
    virtual void save() = 0;
    virtual void restore() = 0;
    /// To time() + window, with the wall at `displacement` [m] at its end. SoilLost if that cannot be.
    virtual SoilWindow advance(double window, double displacement) = 0;
    virtual void accept() = 0;
    virtual void finish() = 0;
};

std::unique_ptr<SoilSide> soilInProcess(const std::filesystem::path& caseFolder, int threads);
std::unique_ptr<SoilSide> soilBySocket(const std::filesystem::path& socket);
std::unique_ptr<SoilSide> soilByFmu(const std::filesystem::path& unpackedFmu);
} // namespace springWall
