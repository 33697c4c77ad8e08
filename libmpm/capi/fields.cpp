// Values in and out, and what they add up to.
#include "capi/handles.hpp"

using namespace mpm;
using namespace mpm::capi;
using coupling::FieldName, coupling::Participant;

namespace
{
static_assert(int(FieldName::Displacement) == MPM_DISPLACEMENT && int(FieldName::Velocity) == MPM_VELOCITY &&
              int(FieldName::RigidPose) == MPM_RIGID_POSE && int(FieldName::RigidTwist) == MPM_RIGID_TWIST &&
              int(FieldName::Force) == MPM_FORCE && int(FieldName::Torque) == MPM_TORQUE &&
              int(FieldName::Traction) == MPM_TRACTION && int(FieldName::Stress) == MPM_STRESS &&
              int(FieldName::ContactArea) == MPM_CONTACT_AREA);

FieldName fieldOf(int32_t field)
{
    return enumerator(field, FieldName::ContactArea, "field");
}

std::span<double> values(double* pointer, std::size_t count)
{
    return {array(pointer, count, "values"), count};
}

void copy(const Vector3& from, double (&to)[3])
{
    std::copy(from.begin(), from.end(), to);
}
} // namespace

extern "C" {
const char* mpm_field_word(int32_t field)
{
    return field < 0 || field > MPM_CONTACT_AREA ? "unknown" : coupling::fieldWord(FieldName(field));
}

mpm_status mpm_participant_value_count(mpm_participant* participant, const char* surface, int32_t field, size_t* count)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        *required(count, "count") = own.valueCount(surface, fieldOf(field));
    });
}

mpm_status mpm_participant_write_field(mpm_participant* participant, const char* surface, int32_t field,
                                       const double* given, size_t count, double relative_time)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        own.writeField(surface, fieldOf(field), {array(given, count, "values"), count}, relative_time);
    });
}

mpm_status mpm_participant_read_field(mpm_participant* participant, const char* surface, int32_t field, double* out,
                                      size_t count)
{
    return withParticipant(participant, [&](Participant& own) {
        own.readField(required(surface, "surface"), fieldOf(field), values(out, count));
    });
}

mpm_status mpm_participant_window_average(mpm_participant* participant, const char* surface, int32_t field, double* out,
                                          size_t count)
{
    return withParticipant(participant, [&](Participant& own) {
        own.windowAverage(required(surface, "surface"), fieldOf(field), values(out, count));
    });
}

mpm_status mpm_participant_resultants(mpm_participant* participant, const char* surface, mpm_resultants* resultants)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        required(resultants, "resultants");
        const coupling::Resultants found = own.resultants(surface);
        copy(found.force, resultants->force);
        copy(found.torque, resultants->torque);
        copy(found.impulse, resultants->impulse);
        copy(found.momentImpulse, resultants->moment_impulse);
        resultants->contact_area = found.contactArea;
    });
}

mpm_status mpm_participant_interface_work(mpm_participant* participant, const char* surface, double* work)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        *required(work, "work") = own.interfaceWork(surface);
    });
}
}
