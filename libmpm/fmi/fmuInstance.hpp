#pragma once
/// One instance of an FMU: a participant driven by the calls of FMI 3.0 for Co-Simulation.
///
/// Inputs hold for the end of a communication step: within it a surface goes from where it is to where they say, with
/// the interpolation of system/couplingDict. A field is written once the master has set one of its variables.
/// Outputs are those at the end of the last step. Parameters are settings of a participant, which is made anew when
/// they change.
///
/// Steps that can be undone are kept back: files are written once the master says that it will not go back before a
/// point (noSetFMUStatePriorToCurrentPoint), and at the end.
///
/// A refused call changes nothing. Not safe for two threads at one instance; several instances are.
#include "fmi/fmuCase.hpp"
#include "fmi/fmuLog.hpp"
#include "fmi/fmuState.hpp"
#include "fmi/fmuVariables.hpp"

#include <initializer_list>
#include <map>
#include <memory>
#include <vector>

namespace mpm::fmi
{
class Instance
{
  public:
    /// Refusal or InputError if the case cannot be used.
    Instance(std::string name, const std::string& token, const std::filesystem::path& resources, Log log);
    ~Instance();

    Log& log() { return log_; }
    Phase phase() const { return phase_; }
    /// Refusal unless the instance is in one of these states.
    void require(std::initializer_list<Phase> allowed) const;

    void enterInitializationMode(double startTime, std::optional<double> stopTime);
    void exitInitializationMode();
    void terminate();
    void reset();
    /// Refusal with fmi3Discard where the step cannot be taken as it was asked for. Returns the time reached.
    double doStep(double from, double length, bool stepsBeforeStand);

    void get(std::span<const fmi3ValueReference> references, Type type, std::span<double> out);
    void set(std::span<const fmi3ValueReference> references, Type type, std::span<const double> in);
    const std::string& getText(fmi3ValueReference reference) const;
    void setText(fmi3ValueReference reference, const std::string& text);

    /// States that were handed out are the instance's; a handle that is none of them is refused.
    fmi3FMUState saveState(fmi3FMUState reused);
    void restoreState(fmi3FMUState handle);
    bool owns(fmi3FMUState handle) const { return states_.count(handle) > 0; }
    void freeState(fmi3FMUState handle);
    const std::vector<std::byte>& serialise(fmi3FMUState handle);
    fmi3FMUState deserialise(std::span<const std::byte> bytes);

    double time() const { return values_[0]; }

  private:
    void build();
    void prepare();
    void initialise();
    void clear();
    void refreshOutputs();
    bool isSet(const InputField& input) const;
    void writeInputs(double relativeTime);
    void sayAgain(const coupling::Snapshot& before);
    void accept();
    std::vector<coupling::Setting> settings() const;
    bool sameParameters(const std::vector<double>& values) const;
    const Variable& variable(fmi3ValueReference reference, Type type) const;
    void requireSettable(const Variable& variable) const;
    State& stateAt(fmi3FMUState handle);

    std::string name_, token_;
    std::filesystem::path case_; ///< resources/case
    Log log_;
    Variables variables_;
    std::vector<Parameter> parameters_;

    std::unique_ptr<CaseCopy> copy_;
    std::unique_ptr<coupling::Participant> participant_;
    std::string copiedTo_;    ///< the outputFolder it is a copy for
    bool calculated_ = false; ///< has a step been taken in it?
    bool stale_ = false;      ///< a parameter was set since the participant was made

    Phase phase_ = Phase::Instantiated;
    std::vector<double> values_;
    std::vector<bool> touched_;
    std::vector<double> said_; ///< values that were written to the participant last,
    std::vector<bool> saidOf_; ///< and for which of the input fields
    std::string outputFolder_;
    std::optional<double> stopTime_;
    bool pending_ = false;
    double window_ = 0;
    Index substeps_ = 0;

    std::map<fmi3FMUState, std::unique_ptr<State>> states_;
};
} // namespace mpm::fmi
