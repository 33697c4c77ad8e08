#pragma once
/// Messages of an FMU to its importer, by the category of their status. Errors are told always, the rest where logging
/// is on (FMI 3.0.2, section 2.2.4).
#include "fmi/fmi3Functions.h"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace mpm::fmi
{
/// Names and descriptions of the log categories, in the order of modelDescription.xml.
inline constexpr std::array<std::pair<const char*, const char*>, 5> logCategories = {
    {{"logEvents", "what the calculation does: steps taken, states stored"},
     {"logStatusWarning", "messages of calls that return fmi3Warning"},
     {"logStatusDiscard", "messages of calls that return fmi3Discard: the step is not taken, nothing has changed"},
     {"logStatusError", "messages of calls that return fmi3Error"},
     {"logStatusFatal", "messages of calls that return fmi3Fatal"}}};

/// Why a call is not done, and what it answers.
class Refusal : public std::runtime_error
{
  public:
    explicit Refusal(const std::string& what, fmi3Status status = fmi3Error) : std::runtime_error(what), status_(status)
    {}
    fmi3Status status() const { return status_; }

  private:
    fmi3Status status_;
};

class Log
{
  public:
    Log(fmi3LogMessageCallback callback, fmi3InstanceEnvironment environment, bool on)
        : callback_(callback), environment_(environment)
    {
        on_.fill(on);
    }

    /// All categories, or those named; Refusal for one there is not.
    void set(bool on, std::size_t count, const fmi3String* categories);
    void operator()(fmi3Status status, const std::string& message) const;

  private:
    fmi3LogMessageCallback callback_;
    fmi3InstanceEnvironment environment_;
    std::array<bool, logCategories.size()> on_{};
};
} // namespace mpm::fmi
