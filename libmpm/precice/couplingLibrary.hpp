#pragma once
/// What is asked of a coupling library: the verbs of precice::Participant, version 3 (G. Chourdakis et al. 2022,
/// preCICE v2: a sustainable and user-friendly coupling library, Open Res. Europe 2:51; precice.org, porting guide 2 to
/// 3). All that libmpm does with them is written against this concept, so it is tested without the library against a
/// peer that lives in the test (tests/unit/preciceCoupling.cpp), and only preciceLink.cpp knows preCICE itself.
#include <concepts>
#include <span>
#include <string>
#include <vector>

namespace mpm::precice
{
template <class L>
concept CouplingLibrary = requires(L& library, const L& asked, const std::string& mesh, const std::string& data,
                                   std::span<const double> in, std::span<double> out, std::span<int> newIds,
                                   std::span<const int> ids, double seconds)
{
    // meshes, before initialize()
    {
        asked.getMeshDimensions(mesh)
        } -> std::same_as<int>;
    {
        asked.getDataDimensions(mesh, data)
        } -> std::same_as<int>;
    {
        asked.requiresMeshConnectivityFor(mesh)
        } -> std::same_as<bool>;
    library.setMeshVertices(mesh, in, newIds);
    library.setMeshEdges(mesh, ids);
    library.setMeshTriangles(mesh, ids);
    // time
    {
        library.requiresInitialData()
        } -> std::same_as<bool>;
    library.initialize();
    {
        asked.isCouplingOngoing()
        } -> std::same_as<bool>;
    {
        asked.getMaxTimeStepSize()
        } -> std::same_as<double>;
    library.advance(seconds);
    {
        asked.isTimeWindowComplete()
        } -> std::same_as<bool>;
    library.finalize();
    // data; the time of a value read counts from now
    asked.readData(mesh, data, ids, seconds, out);
    library.writeData(mesh, data, ids, in);
    // implicit coupling: windows are repeated from their start
    {
        library.requiresWritingCheckpoint()
        } -> std::same_as<bool>;
    {
        library.requiresReadingCheckpoint()
        } -> std::same_as<bool>;
};
} // namespace mpm::precice
