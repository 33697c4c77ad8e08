#pragma once
/// The participants and states that are alive, by numbers that C holds as pointers. Numbers are odd, so that no address
/// of an object is one, and are never given twice: what was freed stays unknown.
#include "capi/guard.hpp"
#include "coupling/participant.hpp"

#include <memory>
#include <mutex>
#include <unordered_map>

namespace mpm::capi
{
struct LiveParticipant
{
    explicit LiveParticipant(coupling::Participant made) : participant(std::move(made)) {}
    coupling::Participant participant;
    std::mutex busy; ///< held during a call
};

struct LiveState
{
    explicit LiveState(coupling::Snapshot made) : snapshot(std::move(made)) {}
    coupling::Snapshot snapshot;
    std::mutex mutex;
    std::vector<std::byte> bytes; ///< between the call that asks how many and the one that takes them
    const mpm_participant* bytesOf = nullptr;
};

/// One for all kinds.
std::uintptr_t newHandle() noexcept;

template <class Live, class Handle>
class Registry
{
  public:
    Handle* add(std::shared_ptr<Live> live)
    {
        const std::uintptr_t handle = newHandle();
        const std::lock_guard lock(mutex_);
        live_.emplace(handle, std::move(live));
        return reinterpret_cast<Handle*>(handle);
    }
    std::shared_ptr<Live> find(const Handle* handle) const
    {
        const std::lock_guard lock(mutex_);
        const auto found = live_.find(reinterpret_cast<std::uintptr_t>(handle));
        if (found == live_.end())
            throw Refusal{MPM_BAD_HANDLE, handle ? "badHandle: never made, or destroyed" : "badHandle: it is null"};
        return found->second;
    }
    void remove(const Handle* handle)
    {
        const std::lock_guard lock(mutex_);
        live_.erase(reinterpret_cast<std::uintptr_t>(handle));
    }

  private:
    mutable std::mutex mutex_;
    std::unordered_map<std::uintptr_t, std::shared_ptr<Live>> live_;
};

/// They live as long as the process: a program may end with participants of its own still there.
Registry<LiveParticipant, mpm_participant>& participants();
Registry<LiveState, mpm_state>& states();

/// A participant for the length of a call.
class InCall
{
  public:
    explicit InCall(const mpm_participant* handle)
        : live_(participants().find(handle)), lock_(live_->busy, std::try_to_lock)
    {
        if (!lock_)
            throw Refusal{MPM_BUSY, "busy: another thread is in a call of this participant"};
    }
    coupling::Participant& operator*() const { return live_->participant; }
    coupling::Participant* operator->() const { return &live_->participant; }

  private:
    std::shared_ptr<LiveParticipant> live_; // longer than the lock
    std::unique_lock<std::mutex> lock_;
};

/// The frame of a call: call(Participant&).
template <class Call>
mpm_status withParticipant(const mpm_participant* handle, Call&& call) noexcept
{
    return guarded([&] {
        const InCall participant(handle);
        return call(*participant);
    });
}
} // namespace mpm::capi
