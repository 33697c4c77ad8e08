#pragma once
/// What constant/contactProperties says, as plain data; contact.hpp has the law and the words.
#include "nodal/rigidBody.hpp"

#include <memory>
#include <string>
#include <vector>

namespace mpm::nodal
{
enum class ContactDetection
{
    domains,
    nodes
};

/// What a dictionary says of contact, as plain data.
struct ContactProperties
{
    std::vector<std::string> bodies;                        ///< names
    std::vector<int> bodyOf;                                ///< by Particles::material
    std::vector<std::vector<double>> mu;                    ///< of each pair of bodies, symmetric
    std::vector<std::shared_ptr<const RigidMotion>> motion; ///< of each body; null: it is not rigid; empty: none is
    ContactDetection detection = ContactDetection::domains;
};
} // namespace mpm::nodal
