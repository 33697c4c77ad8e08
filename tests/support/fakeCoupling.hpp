#pragma once
// A coupling library and its peer in one object, and a soil of one freedom: what precice/coupledRun.hpp does with them
// can be followed number by number.
#include "coupling/participant.hpp"
#include "precice/couplingLibrary.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm::tests
{
using mpm::Index;
using mpm::Vector3;
using mpm::coupling::FieldName;

struct Written
{
    double time;
    int iteration;
    std::vector<double> values;
};

// Obeys preCICE's rules: what must be called, must be called, in order; else std::logic_error.
class FakeLibrary
{
  public:
    double window = 0.5, end = 2;
    int iterations = 1;   // of every window; 1: explicit
    int dieInWindow = -1; // the peer is gone when this window is advanced
    bool initialData = true, connectivity = true;
    int meshDimensions = 2;
    std::map<std::string, int> components = {{"Displacement", 2}, {"Rotation", 1}, {"Velocity", 2},   {"Force", 2},
                                             {"Torque", 1},       {"Traction", 2}, {"ContactArea", 1}};
    std::map<std::string, std::vector<double>> coordinates;
    std::map<std::string, std::vector<int>> edges;
    std::map<std::string, std::vector<Written>> written;
    bool finalized = false;

    // Where the peer is: x = t^2, which iterates come to from 2^-k beyond.
    double place(double time) const
    {
        return time * time + (iteration_ + 1 < iterations ? window * std::pow(0.5, iteration_) * 0.1 : 0);
    }

    int getMeshDimensions(const std::string&) const { return meshDimensions; }
    int getDataDimensions(const std::string&, const std::string& data) const { return components.at(data); }
    bool requiresMeshConnectivityFor(const std::string&) const { return connectivity; }
    void setMeshVertices(const std::string& mesh, std::span<const double> x, std::span<int> ids)
    {
        coordinates[mesh].assign(x.begin(), x.end());
        for (std::size_t i = 0; i < ids.size(); ++i)
            ids[i] = int(10 + i);
    }
    void setMeshEdges(const std::string& mesh, std::span<const int> ids) { edges[mesh].assign(ids.begin(), ids.end()); }
    void setMeshTriangles(const std::string&, std::span<const int>) { require(false, "triangles in 2D"); }

    bool requiresInitialData()
    {
        asked_ = true;
        return initialData;
    }
    void initialize()
    {
        require(asked_ && (!initialData || !written.empty()), "initial data are written before initialize");
        initialized_ = true;
        checkpointDue_ = iterations > 1;
    }
    bool isCouplingOngoing() const { return start_ < end - 1e-12; }
    double getMaxTimeStepSize() const { return window - offset_; }
    bool isTimeWindowComplete() const { return complete_; }
    void advance(double dt)
    {
        require(initialized_ && !checkpointDue_ && !returnDue_, "a checkpoint was asked for");
        require(dt > 0 && dt <= window - offset_ + 1e-12, "a step beyond the window");
        if (windowNumber_ == dieInWindow)
            throw std::runtime_error("Receiving data from another participant failed.\nMore lines of it.");
        offset_ += dt;
        complete_ = false;
        if (offset_ < window - 1e-12)
            return;
        offset_ = 0;
        if (++iteration_ < iterations)
        {
            returnDue_ = true;
            return;
        }
        iteration_ = 0;
        complete_ = true;
        start_ += window;
        ++windowNumber_;
        checkpointDue_ = iterations > 1 && isCouplingOngoing();
    }
    bool requiresWritingCheckpoint() { return std::exchange(checkpointDue_, false); }
    bool requiresReadingCheckpoint() { return std::exchange(returnDue_, false); }
    void finalize()
    {
        require(!finalized, "finalize once");
        finalized = true;
    }
    void readData(const std::string&, const std::string& data, std::span<const int> ids, double relative,
                  std::span<double> out) const
    {
        require(initialized_ && relative >= 0 && relative <= window - offset_ + 1e-12, "a time beyond the window");
        require(out.size() == ids.size() * std::size_t(components.at(data)), "values for the vertices");
        std::fill(out.begin(), out.end(), 0);
        for (std::size_t i = 0; i < out.size(); i += std::size_t(components.at(data)))
            out[i] = data == "Rotation" ? 0 : place(start_ + offset_ + relative);
    }
    void writeData(const std::string&, const std::string& data, std::span<const int> ids, std::span<const double> in)
    {
        require(in.size() == ids.size() * std::size_t(components.at(data)), "values for the vertices");
        written[data].push_back({start_ + offset_, iteration_, {in.begin(), in.end()}});
    }

  private:
    static void require(bool holds, const char* rule)
    {
        if (!holds)
            throw std::logic_error(rule);
    }
    bool asked_ = false, initialized_ = false, checkpointDue_ = false, returnDue_ = false, complete_ = false;
    double start_ = 0, offset_ = 0;
    int iteration_ = 0, windowNumber_ = 0;
};

// Pushes back with stiffness * x and remembers where it was pushed: sum of (x - old x)^2, so that another way to the
// same place is another state.
class FakeSoil
{
  public:
    struct State
    {
        double time = 0, x = 0, path = 0, force = 0, mean = 0;
    };
    struct Sample
    {
        double time, relative, x;
    };
    double stiffness = 100;
    Index discardAt = -1; // windows begun
    mpm::coupling::SurfaceKind surfaceKind = mpm::coupling::SurfaceKind::Rigid;
    std::vector<State> accepted;
    std::vector<Sample> samples;
    State now, onDisk;
    int saves = 0, restores = 0, advances = 0, finalizes = 0;
    double farthest = 1e300; // beyond it, a sample is a jump

    int dimension() const { return 2; }
    Vector3 reference(const std::string&) const { return {4, 1, 0}; }
    mpm::coupling::SurfaceMesh mesh(const std::string&) const
    {
        return {2, {{4, 0, 0}, {4, 1, 0}, {4, 2, 0}}, {{0, 1, -1}, {1, 2, -1}}};
    }
    std::size_t valueCount(const std::string&, FieldName field) const
    {
        const std::size_t vertices = surfaceKind == mpm::coupling::SurfaceKind::Rigid ? 1 : 3;
        return vertices * (field == FieldName::ContactArea ? 1 : 3);
    }
    void initialize() {}
    void writeField(const std::string&, FieldName field, std::span<const double> values, double relative)
    {
        if (field != FieldName::RigidPose && field != FieldName::Displacement && field != FieldName::Force)
            return;
        const double x = values[0] - (field == FieldName::RigidPose ? 4 : 0);
        if (std::abs(x) > farthest)
            throw mpm::coupling::CouplingError(mpm::coupling::Fault::jump, "too far");
        samples.push_back({now.time, relative, x});
    }
    mpm::coupling::Advance advance(double step)
    {
        if (advances++ == discardAt)
            return {now.time, 0, mpm::coupling::Status::discarded, "the soil flew apart"};
        const double before = now.x;
        now.x = samples.back().x;
        now.path += (now.x - before) * (now.x - before);
        now.time += step;
        now.force = -stiffness * now.x - now.path;
        now.mean = -stiffness * 0.5 * (now.x + before) - now.path;
        return {now.time, 3, mpm::coupling::Status::reached, ""};
    }
    void readField(const std::string&, FieldName, std::span<double> out) const { fill(out, now.force); }
    void windowAverage(const std::string&, FieldName, std::span<double> out) const { fill(out, now.mean); }
    State saveState() { return ++saves, now; }
    void restoreState(const State& state) { ++restores, now = state; }
    void acceptWindow() { accepted.push_back(now); }
    double time() const { return now.time; }
    void finalize()
    {
        ++finalizes;
        onDisk = accepted.empty() ? State{} : accepted.back();
    }

  private:
    static void fill(std::span<double> out, double value)
    {
        std::fill(out.begin(), out.end(), 0);
        for (std::size_t i = 0; i < out.size(); i += 3)
            out[i] = value;
    }
};
} // namespace mpm::tests
