// Effects of contact between bodies.
#include "case/effectCatalogue.hpp"

namespace mpm::cases
{
std::vector<Effect> contactEffects()
{
    return {};
}
} // namespace mpm::cases
