#pragma once
/// What was read and seeded, as the lines a person reads first.
#include "seeding/seedState.hpp"

namespace mpm::seeding
{
std::string report(const geometry::BodyGeometry& body, const Seeding& seeded,
                   const std::vector<SeedMaterial>& materials, const SeedOptions& options);
} // namespace mpm::seeding
