#pragma once
/// constant/contactProperties (nodal/contact.hpp has the words); absent: all materials hold together.
#include "constitutive/material.hpp"
#include "dictionary/dictionary.hpp"
#include "nodal/contactProperties.hpp"

namespace mpm::cases
{
/// Bodies of the materials, which are in the order of Particles::material. A body of materials no particle is of is
/// left out of bodyOf.
nodal::ContactProperties readContact(const dictionary::Dictionary& contactProperties,
                                     const std::vector<constitutive::Material>& materials);
} // namespace mpm::cases
