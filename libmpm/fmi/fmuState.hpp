#pragma once
/// The state of an instance of an FMU, as fmi3GetFMUState hands it out: the participant's snapshot and, beside it, what
/// the master set and what it may read. As bytes it can be taken to another process.
#include "coupling/participant.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpm::fmi
{
/// The states of an instance (FMI 3.0.2, figures 5 and 9): there is no Configuration, Event or Reconfiguration Mode.
enum class Phase
{
    Instantiated,
    InitializationMode,
    StepMode,
    Terminated
};
const char* phaseName(Phase phase);

struct State
{
    Phase phase = Phase::Instantiated;
    std::vector<double> values;        ///< of all variables, pending inputs among them
    std::vector<bool> touched;         ///< variables the master has set
    std::vector<double> said;          ///< values that were written to the participant last
    std::vector<bool> saidOf;          ///< and for which of the input fields
    std::optional<double> stopTime;    ///< [s]
    bool pending = false;              ///< steps were taken that are not accepted yet
    double window = 0;                 ///< length of the last communication step [s]
    Index substeps = 0;                ///< it took
    coupling::Snapshot snapshot;       ///< empty in Instantiated, and where there are bytes
    std::vector<std::byte> serialised; ///< of the participant, where it came as bytes
    std::vector<std::byte> whole;      ///< all of it as bytes, once they were asked for
};

/// `participant`: bytes of its snapshot. The token of the FMU and a check sum go with them.
std::vector<std::byte> bytesOf(const State& state, std::span<const std::byte> participant, const std::string& token);
/// CouplingError (badState) for bytes that are damaged or of another FMU.
State stateOf(std::span<const std::byte> bytes, const std::string& token, std::size_t variables, std::size_t inputs,
              std::size_t values);
} // namespace mpm::fmi
