#pragma once
/// The variables of an FMU, from the coupling surfaces and dictionaries of its case. Who exports the FMU and the FMU
/// itself make the same list with the same code; a value reference is a place in it.
///
///     time
///     threads, outputFolder, <dictionary>.<word>                     parameters (fmi/fmuParameters.hpp)
///     <surface>.vertices                                             places in the reference configuration [m]
///     Rigid       in   position.{x,y,z} angle | quaternion.{w,x,y,z} of the reference point, at the end of a step
///                 in   velocity.{x,y,z} angularVelocity.{x,y,z}
///                 out  force.{x,y,z} torque.{x,y,z}                  means over the last communication step
///                 out  forceNow.* torqueNow.* contactArea            at its end
///     all kinds   in   atVertices.{displacement,velocity} | atVertices.{force,traction}
///                 out  atVertices.{...}, force and traction as means; interfaceWork
///     energy.{kinetic,strain,dissipation,gravityWork,interfaceWork,residual}, momentum.{x,y,z}
///     timeStep, substeps, stableTimeStep
///
/// In 2D vectors have x and y, rotations angle and z; arrays have three (stresses six) components as in
/// coupling/field.hpp.
#include "fmi/fmuParameters.hpp"

#include <functional>
#include <optional>

namespace mpm::fmi
{
enum class Type
{
    float64,
    int64,
    string
};

enum class Causality
{
    independent,
    parameter,
    calculatedParameter,
    input,
    output
};

/// What outputs are read from.
struct Reading
{
    const coupling::Participant& participant;
    double window = 0;         ///< length of the last communication step [s]; 0 before the first
    Index substeps = 0;        ///< steps it took
    coupling::Balance balance; ///< of the participant: sums over all particles, so once
};

struct Variable
{
    std::string name, description;
    Type type = Type::float64;
    Causality causality = Causality::output;
    Unit unit = {};
    std::vector<std::size_t> shape = {};                              ///< empty: a scalar
    std::vector<double> start = {};                                   ///< of parameters and inputs
    std::function<void(const Reading&, std::span<double>)> read = {}; ///< of outputs
    std::optional<Parameter> parameter = {};                          ///< a word of a dictionary
    std::size_t first = 0;                                            ///< place of its values among those of all

    std::size_t size() const;
};

/// A field of a surface that inputs make up.
struct InputField
{
    std::string surface;
    coupling::FieldName field;
    std::vector<std::size_t> variables; ///< one array, or the components of a pose or twist
};

struct Variables
{
    std::vector<Variable> all;
    std::vector<InputField> inputs;
    std::size_t valueCount = 0;
    int dim = 2;

    /// Place of a variable that is always there.
    std::size_t at(const std::string& name) const;
    /// The numbers Participant::writeField takes, from those of all variables.
    std::vector<double> fieldValues(const InputField& input, std::span<const double> values) const;
    std::vector<double> startValues() const;
};

/// InputError if two would have one name.
Variables variablesOf(const coupling::Participant& participant, const std::vector<Parameter>& parameters);
} // namespace mpm::fmi
