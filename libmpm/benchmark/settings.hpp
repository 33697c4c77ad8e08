#pragma once
/// What benchmarkStep measures: the rows its options ask for. Several words or numbers, separated by commas or blanks,
/// make a row for every combination; an unknown word or a bad number is an InputError with what is allowed.
///
///     -dimension 2,3  -shape uGIMP  -stressUpdate MUSL,USL  -law mohrCoulomb  -particles 7.2k,115k  -threads 1,2
#include "case/application.hpp"
#include "stepping/stepper.hpp"

namespace mpm::benchmark
{
struct Setting
{
    int dimension = 2;
    std::string shape = "uGIMP";
    stepping::StressUpdate stressUpdate = stepping::StressUpdate::MUSL;
    std::string law = "mohrCoulomb";
    Index particles = 7200; ///< wanted; the nearest column is measured
    int threads = 1;
    bool splitting = false;
    double picRate = 2; ///< [1/s], the case's
    bool naive = true;  ///< measure the naive step too
    bool quick = false; ///< smaller first columns, fewer and shorter blocks
};

/// The options above and -splitting, -picRate R, -json FILE, -naive on|off, -quick, for ApplicationInfo::options.
std::vector<cases::ExtraOption> settingOptions();
/// Threads vary fastest, then particles.
std::vector<Setting> readSettings(const cases::Options& options);
} // namespace mpm::benchmark
