#include "precice/exchange.hpp"

#include <cmath>

namespace mpm::precice
{
using coupling::FieldName;
using coupling::SurfaceKind;

namespace
{
/// Vectors of `dim` components become three; in 2D a scalar is about z.
Values widened(Quantity quantity, int dim, const Values& values)
{
    if (dim == 3)
        return values;
    Values out;
    if (componentsOf(quantity, dim) == 1)
        for (double about : values)
            out.insert(out.end(), {0, 0, about});
    else
        for (std::size_t i = 0; i + 1 < values.size(); i += 2)
            out.insert(out.end(), {values[i], values[i + 1], 0});
    return out;
}

Vector3 vectorOf(Quantity quantity, int dim, const std::map<Quantity, Values>& read)
{
    const auto found = read.find(quantity);
    if (found == read.end())
        return {};
    const Values v = widened(quantity, dim, found->second);
    return {v[0], v[1], v[2]};
}

std::vector<FieldValues> rigidFields(int dim, const Vector3& reference, const std::map<Quantity, Values>& read)
{
    std::vector<FieldValues> out;
    if (read.count(Quantity::Displacement) || read.count(Quantity::Rotation))
    {
        const auto pose =
            poseOf(reference, vectorOf(Quantity::Displacement, dim, read), vectorOf(Quantity::Rotation, dim, read));
        out.push_back({FieldName::RigidPose, Values(pose.begin(), pose.end())});
    }
    if (read.count(Quantity::Velocity) || read.count(Quantity::AngularVelocity))
    {
        const Vector3 v = vectorOf(Quantity::Velocity, dim, read), w = vectorOf(Quantity::AngularVelocity, dim, read);
        out.push_back({FieldName::RigidTwist, {v[0], v[1], v[2], w[0], w[1], w[2]}});
    }
    return out;
}
} // namespace

std::array<double, 7> poseOf(const Vector3& reference, const Vector3& u, const Vector3& r)
{
    const double angle = std::hypot(r[0], r[1], r[2]);
    const double scale = angle > 0 ? std::sin(0.5 * angle) / angle : 0.5;
    return {reference[0] + u[0], reference[1] + u[1], reference[2] + u[2], std::cos(0.5 * angle),
            scale * r[0],        scale * r[1],        scale * r[2]};
}

std::vector<FieldValues> toParticipant(const SurfaceLink& link, int dim, const Vector3& reference,
                                       const std::map<Quantity, Values>& read)
{
    if (link.kind == SurfaceKind::Rigid)
        return rigidFields(dim, reference, read);
    std::vector<FieldValues> out;
    for (const auto& [quantity, values] : read)
        out.push_back({sourceOf(quantity), widened(quantity, dim, values)});
    return out;
}

FieldName sourceOf(Quantity quantity)
{
    switch (quantity)
    {
    case Quantity::Velocity:
        return FieldName::Velocity;
    case Quantity::Force:
        return FieldName::Force;
    case Quantity::Torque:
        return FieldName::Torque;
    case Quantity::Traction:
        return FieldName::Traction;
    case Quantity::ContactArea:
        return FieldName::ContactArea;
    default:
        return FieldName::Displacement;
    }
}

Values toPrecice(Quantity quantity, int dim, const Values& field)
{
    if (dim == 3 || quantity == Quantity::ContactArea)
        return field;
    const bool aboutZ = componentsOf(quantity, dim) == 1;
    Values out;
    for (std::size_t i = 0; i + 2 < field.size(); i += 3)
        if (aboutZ)
            out.push_back(field[i + 2]);
        else
            out.insert(out.end(), {field[i], field[i + 1]});
    return out;
}
} // namespace mpm::precice
