// From create to destroy: what a participant is, and its way through time.
#include "base/version.hpp"
#include "capi/handles.hpp"

using namespace mpm;
using namespace mpm::capi;
using coupling::Participant;

namespace
{
std::vector<coupling::Setting> settingsOf(const mpm_setting* settings, std::size_t count)
{
    array(settings, count, "settings");
    std::vector<coupling::Setting> made;
    for (std::size_t i = 0; i < count; ++i)
        made.push_back({required(settings[i].file, "the file of a setting"),
                        required(settings[i].word, "the word of a setting"),
                        required(settings[i].value, "the value of a setting")});
    return made;
}
} // namespace

extern "C" {
const char* mpm_version(void)
{
    static const std::string version = projectVersion();
    return version.c_str();
}

int32_t mpm_abi_version(void)
{
    return MPM_ABI_VERSION;
}

mpm_status mpm_participant_create(const char* case_folder, const mpm_setting* settings, size_t setting_count,
                                  int32_t threads, mpm_participant** participant)
{
    return guarded([&] {
        required(case_folder, "case_folder");
        required(participant, "participant");
        if (threads < 0)
            throw Refusal{MPM_BAD_VALUE,
                          "badValue: threads is " + std::to_string(threads) + ", allowed are 0 and more"};
        *participant = participants().add(
            std::make_shared<LiveParticipant>(Participant(case_folder, settingsOf(settings, setting_count), threads)));
    });
}

mpm_status mpm_participant_destroy(mpm_participant* participant)
{
    if (!participant)
        return guarded([] {});
    return guarded([&] {
        const InCall last(participant);
        participants().remove(participant);
    });
}

mpm_status mpm_participant_initialize(mpm_participant* participant)
{
    return withParticipant(participant, [](Participant& own) { own.initialize(); });
}

mpm_status mpm_participant_lifecycle(mpm_participant* participant, int32_t* lifecycle)
{
    using coupling::Lifecycle;
    static_assert(int(Lifecycle::Created) == MPM_CREATED && int(Lifecycle::Initialized) == MPM_INITIALIZED &&
                  int(Lifecycle::Stepping) == MPM_STEPPING && int(Lifecycle::Finalized) == MPM_FINALIZED);
    return withParticipant(participant,
                           [&](Participant& own) { *required(lifecycle, "lifecycle") = int32_t(own.lifecycle()); });
}

mpm_status mpm_participant_dimension(mpm_participant* participant, int32_t* dimension)
{
    return withParticipant(participant, [&](Participant& own) { *required(dimension, "dimension") = own.dimension(); });
}

mpm_status mpm_participant_time(mpm_participant* participant, double* time)
{
    return withParticipant(participant, [&](Participant& own) { *required(time, "time") = own.time(); });
}

mpm_status mpm_participant_stable_time_step(mpm_participant* participant, double* step)
{
    return withParticipant(participant, [&](Participant& own) { *required(step, "step") = own.stableTimeStep(); });
}

mpm_status mpm_participant_advance(mpm_participant* participant, double window, mpm_advance* result)
{
    return withParticipant(participant, [&](Participant& own) -> mpm_status {
        const coupling::Advance reached = own.advance(window);
        if (result)
            *result = {reached.time, reached.substeps};
        if (reached.status == coupling::Status::reached)
            return MPM_OK;
        say(reached.message.c_str());
        return MPM_DISCARDED;
    });
}

mpm_status mpm_participant_balance(mpm_participant* participant, mpm_balance* balance)
{
    return withParticipant(participant, [&](Participant& own) {
        required(balance, "balance");
        const coupling::Balance now = own.balance();
        *balance = {
            now.kineticEnergy, now.strainEnergy, now.dissipation, now.gravityWork,
            now.interfaceWork, now.motionWork,   now.residual,    {now.momentum[0], now.momentum[1], now.momentum[2]}};
    });
}

mpm_status mpm_participant_accept_window(mpm_participant* participant)
{
    return withParticipant(participant, [](Participant& own) { own.acceptWindow(); });
}

mpm_status mpm_participant_finalize(mpm_participant* participant)
{
    return withParticipant(participant, [](Participant& own) { own.finalize(); });
}
}
