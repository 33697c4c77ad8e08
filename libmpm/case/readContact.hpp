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
/// Motions of materials of law rigid (constitutive/rigid.hpp), each of which is a body of its own; `contact` is null
/// where there is no constant/contactProperties, which is an error if a material is rigid.
void readRigidMotions(const dictionary::Dictionary& materialProperties,
                      const std::vector<constitutive::Material>& materials, int dim, nodal::ContactProperties* contact);
} // namespace mpm::cases
