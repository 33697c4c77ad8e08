#pragma once
/// Bytes as calls of the C interface (capi/mpm.h), in any order and with any arguments a caller can make up: at a
/// participant that steps, at fresh ones, at none. What has to hold after each call:
///
///     a status other than MPM_OK has a word and a text, and is no mistake of ours
///     after it time, lifecycle, energies and momentum are bitwise what they were, and what it would have filled is
///     untouched
///     a window that was reached ends bitwise at time + window
///     a restored participant is seen bitwise as it was when it was saved; bytes of a state that were changed are
///     refused
///
/// Windows are short: a caller may ask for a million steps, but a fuzzer has no use for them.
#include "capi/mpm.h"
#include "fuzz/fuzzing.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace mpm::fuzz
{
/// All that is asked of a participant after each call.
struct Seen
{
    std::array<mpm_status, 3> said{};
    int32_t lifecycle = 0;
    double time = 0;
    mpm_balance balance{};
    bool operator==(const Seen& other) const;
};

class CallSequence
{
  public:
    CallSequence();
    ~CallSequence();

    void run(const std::uint8_t* data, std::size_t size);
    std::size_t calls() const { return calls_; }
    std::size_t granted() const { return granted_; } ///< that were MPM_OK

  private:
    /// Participants: the one that steps, kept from sequence to sequence, and a fresh one.
    enum Slot
    {
        steady,
        fresh,
        slots
    };
    struct Saved
    {
        mpm_state* state;
        mpm_participant* of;
        Seen seen;
    };

    void begin();
    void makeFresh();
    void one();
    mpm_status checked(mpm_status status);
    template <class Call>
    mpm_status changing(mpm_participant* p, Call&& call);

    void describe(mpm_participant* p, unsigned verb);
    void build(mpm_participant* p, unsigned verb);
    void exchange(mpm_participant* p, unsigned verb);
    void keep(mpm_participant* p, unsigned verb);
    void bytesOf(mpm_participant* p);
    void end(mpm_participant* p, unsigned verb);

    unsigned byte();
    mpm_participant* participant();
    std::size_t savedState();
    const char* name();
    int32_t enumerator();
    double window();
    std::vector<double> values(std::size_t wanted);

    Folder folder_;
    std::array<mpm_participant*, slots> p_{};
    mpm_state* start_ = nullptr; ///< of the steady one
    std::vector<Saved> saved_;
    std::vector<mpm_participant*> gone_; ///< handles that were destroyed
    const std::uint8_t* data_ = nullptr;
    std::size_t left_ = 0, calls_ = 0, granted_ = 0;
};
} // namespace mpm::fuzz
