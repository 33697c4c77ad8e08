// States: saved, restored, as bytes.
#include "capi/handles.hpp"

using namespace mpm;
using namespace mpm::capi;
using coupling::Participant;

extern "C" {
mpm_status mpm_participant_save_state(mpm_participant* participant, mpm_state** state)
{
    return withParticipant(participant, [&](Participant& own) {
        required(state, "state");
        *state = states().add(std::make_shared<LiveState>(own.saveState()));
    });
}

mpm_status mpm_participant_restore_state(mpm_participant* participant, mpm_state* state)
{
    return withParticipant(participant, [&](Participant& own) { own.restoreState(states().find(state)->snapshot); });
}

mpm_status mpm_state_free(mpm_state* state)
{
    if (!state)
        return guarded([] {});
    return guarded([&] {
        const auto last = states().find(state);
        states().remove(state);
    });
}

mpm_status mpm_state_serialise(mpm_participant* participant, mpm_state* state, void* bytes, size_t capacity,
                               size_t* count)
{
    return withParticipant(participant, [&](Participant& own) {
        const auto live = states().find(state);
        const std::lock_guard lock(live->mutex);
        if (live->bytes.empty())
            live->bytes = own.serialise(live->snapshot);
        deliver(live->bytes.data(), live->bytes.size(), static_cast<std::byte*>(bytes), capacity, count);
        if (capacity > 0) // taken
            live->bytes = {};
    });
}

mpm_status mpm_state_deserialise(mpm_participant* participant, const void* bytes, size_t count, mpm_state** state)
{
    return withParticipant(participant, [&](Participant& own) {
        required(state, "state");
        const auto* first = array(static_cast<const std::byte*>(bytes), count, "bytes");
        *state = states().add(std::make_shared<LiveState>(own.deserialise({first, count})));
    });
}
}
