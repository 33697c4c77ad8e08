#pragma once
/// Internal to fmi/: the list of variables while it is made.
#include "fmi/fmuVariables.hpp"

namespace mpm::fmi
{
inline const Unit second{"s", {0, 0, 1}, 0, 1};
inline const Unit metre{"m", {0, 1}, 0, 1};
inline const Unit metrePerSecond{"m/s", {0, 1, -1}, 0, 1};
inline const Unit radian{"rad", {}, 1, 1};
inline const Unit radianPerSecond{"rad/s", {0, 0, -1}, 1, 1};

class VariableList
{
  public:
    using Read = std::function<void(const Reading&, std::span<double>)>;
    using Shape = std::vector<std::size_t>;

    explicit VariableList(int dim) { list_.dim = dim; }
    int dim() const { return list_.dim; }

    std::size_t add(Variable variable);
    std::size_t addInput(const std::string& name, const std::string& description, const Unit& unit,
                         std::vector<double> start, const Shape& shape = {});
    void addInputField(InputField field) { list_.inputs.push_back(std::move(field)); }
    void addOutput(const std::string& name, const std::string& description, const Unit& unit, Read read,
                   const Shape& shape = {});

    /// In 2D what is extensive is per metre of thickness.
    Unit perThickness(Unit unit) const;
    Unit work() const { return perThickness({"J", {1, 2, -2}, 0, 1}); }

    /// InputError if two variables have one name.
    Variables take();

  private:
    Variables list_;
};

/// All variables of a coupling surface.
void addSurface(VariableList& list, const coupling::Participant& participant, const std::string& surface);
} // namespace mpm::fmi
