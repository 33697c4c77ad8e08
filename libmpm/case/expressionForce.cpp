#include "case/expressionForce.hpp"

#include "base/error.hpp"
#include "base/processorClock.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace unit = dictionary::unit;

std::vector<std::string> placeVariables(int dim)
{
    if (dim == 2)
        return {"x", "y", "X", "Y", "t"};
    return {"x", "y", "z", "X", "Y", "Z", "t"};
}

ExpressionForce::ExpressionForce(dictionary::VectorExpression value, int dim) : value_(std::move(value)), dim_(dim) {}

/// Steps call this from many threads, out of which nothing may be thrown: what is wrong waits for takeFault().
void ExpressionForce::acceleration(const state::Particles& p, Index first, int count, double time,
                                   double (&b)[3][lanes]) const
{
    const double begin = threadProcessorNow();
    alignas(64) double t[lanes];
    std::fill_n(t, lanes, time);
    std::vector<const double*> at;
    for (int a = 0; a < dim_; ++a)
        at.push_back(p.x[std::size_t(a)].data() + first);
    for (int a = 0; a < dim_; ++a)
        at.push_back(p.hasX() ? p.X[std::size_t(a)].data() + first : nullptr);
    at.push_back(t);
    for (std::size_t a = 0; a < 3; ++a)
    {
        const Index bad = value_[a].evaluate(at, count, b[a]);
        std::fill(b[a] + count, b[a] + lanes, 0.0);
        if (bad < 0)
            continue;
        const std::size_t i = std::size_t(first + bad);
        std::string place;
        for (int k = 0; k < dim_; ++k)
            place += fmt::format("{}{:g}", k ? ", " : "", p.x[std::size_t(k)][i]);
        const std::lock_guard lock(mutex_);
        faults_.emplace(p.id[i],
                        fmt::format("the body force on particle {} at ({}), {:.9g} s is {}: {}: value: \"{}\"", p.id[i],
                                    place, time, b[a][bad], value_[a].where().text(), value_[a].text()));
        std::fill_n(b[a], lanes, 0.0);
    }
    seconds_ += threadProcessorNow() - begin;
}

std::string ExpressionForce::takeFault() const
{
    const std::lock_guard lock(mutex_);
    const std::string fault = faults_.empty() ? "" : faults_.begin()->second;
    faults_.clear();
    return fault;
}

const dictionary::Expression* ExpressionForce::usesReference() const
{
    for (const auto& component : value_)
        for (const char* name : {"X", "Y", "Z"})
            if (component.uses(name))
                return &component;
    return nullptr;
}

std::string ExpressionForce::describe() const
{
    return fmt::format("({} {} {})", value_[0].text(), value_[1].text(), value_[2].text());
}

std::shared_ptr<const ExpressionForce> readBodyForce(const dictionary::Dictionary& d, int dim)
{
    d.checkDimensions(unit::acceleration);
    const auto variables = placeVariables(dim);
    const auto constants = dictionary::readConstants(d, variables);
    auto value = dictionary::readVectorExpression(d, "value", "body force per unit mass", unit::acceleration, dim,
                                                  variables, constants, true);
    if (std::all_of(value.begin(), value.end(), [](const auto& component) { return component.number() == 0.0; }))
        return nullptr;
    return std::make_shared<ExpressionForce>(std::move(value), dim);
}

std::optional<ReferenceWanted> readFields(const dictionary::Dictionary& control)
{
    std::optional<ReferenceWanted> wanted;
    const auto names = control.get<std::vector<std::string>>(
        {"fields", "what is stored beyond what the method needs", {}, {}, std::vector<std::string>{}});
    for (const auto& name : names)
    {
        if (name != "referencePosition")
        {
            const auto near = nearestWord(name, {"referencePosition"});
            control.fail("fields", "'" + name + "'" + (near.empty() ? "" : " (did you mean 'referencePosition'?)"),
                         "referencePosition");
        }
        wanted = ReferenceWanted{control.where("fields"), "fields: referencePosition"};
    }
    return wanted;
}

void provideReference(state::State& state, const ReferenceWanted& wanted)
{
    if (state.particles.hasX())
        return;
    if (state.step > 0)
        throw InputError(
            wanted.where,
            fmt::format("{}: found a state at time {:.9g} s without /particles/referencePosition, where its "
                        "particles started; allowed: a run from time 0 (startFrom firstTime, -overwrite)",
                        wanted.what, state.time));
    state.particles.enableX();
}
} // namespace mpm::cases
