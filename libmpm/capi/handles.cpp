#include "capi/handles.hpp"

#include <atomic>

namespace mpm::capi
{
std::uintptr_t newHandle() noexcept
{
    static std::atomic<std::uintptr_t> last{0};
    return 2 * ++last + 1;
}

Registry<LiveParticipant, mpm_participant>& participants()
{
    static auto& registry = *new Registry<LiveParticipant, mpm_participant>;
    return registry;
}

Registry<LiveState, mpm_state>& states()
{
    static auto& registry = *new Registry<LiveState, mpm_state>;
    return registry;
}
} // namespace mpm::capi
