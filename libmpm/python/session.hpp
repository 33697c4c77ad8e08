#pragma once
/// A participant and its states as Python holds them. Long calls let other threads of Python run; a thread that then
/// calls the same participant gets a RuntimeError instead of half a step.
#include "coupling/participant.hpp"

#include <pybind11/pybind11.h>

#include <mutex>

namespace mpm::python
{
namespace py = pybind11;

struct Session
{
    coupling::Participant participant;
    std::mutex busy;

    Session(const std::string& folder, const std::vector<coupling::Setting>& settings, int threads)
        : participant(folder, settings, threads)
    {}

    std::unique_lock<std::mutex> enter()
    {
        std::unique_lock lock(busy, std::try_to_lock);
        if (!lock)
            throw std::runtime_error("another thread is in a call of this participant");
        return lock;
    }
    /// For a short call.
    template <class Call>
    auto quick(Call&& call)
    {
        const auto lock = enter();
        return call(participant);
    }
    /// For one that takes its time, in which nothing of Python is touched.
    template <class Call>
    auto slow(Call&& call)
    {
        const auto lock = enter();
        const py::gil_scoped_release others;
        return call(participant);
    }
};

/// A state in memory, with the participant that can make bytes of it; or bytes that came from elsewhere and are looked
/// at when they are restored.
struct Saved
{
    coupling::Snapshot snapshot;
    std::shared_ptr<Session> of;
    std::vector<std::byte> bytes;
};

/// {"system/controlDict": {"maxCo": 0.3}} as settings: numbers, True and False, lists, text as in a dictionary; None
/// takes a word away.
std::vector<coupling::Setting> settingsOf(const py::object& settings);

/// CouplingError (with `fault`), InputError, StepError.
void defineErrors(py::module_& module);
void defineParticipant(py::module_& module);
void defineRecords(py::module_& module);
} // namespace mpm::python
