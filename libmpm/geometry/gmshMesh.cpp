#include "geometry/gmshMesh.hpp"

#include "base/error.hpp"
#include "geometry/elementSides.hpp"
#include "geometry/flatten.hpp"
#include "geometry/geometryFile.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gmsh.h>
#include <unordered_map>

namespace mpm::geometry
{
namespace
{
namespace model = gmsh::model;

class Session
{
  public:
    explicit Session(int dim)
    {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.AbortOnError", 0); // leaves its parser in order; the log has the errors
        // Chords of curves that the file leaves coarse; what it sets itself comes later and wins.
        gmsh::option::setNumber("Mesh.MinimumCirclePoints", dim == 2 ? 180 : 130);
        gmsh::option::setNumber("Mesh.MinimumCurvePoints", dim == 2 ? 101 : 41);
        gmsh::logger::start();
    }
    ~Session()
    {
        gmsh::logger::stop();
        gmsh::finalize();
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
};

/// Lines of gmsh's log that begin with "Error" or "Warning", without that word.
std::vector<std::string> logged(const std::string& kind)
{
    std::vector<std::string> log, found;
    gmsh::logger::get(log);
    for (const std::string& line : log)
        if (line.rfind(kind, 0) == 0)
            if (const auto text = line.find_first_not_of(" :", kind.size()); text != std::string::npos)
                if (std::find(found.begin(), found.end(), line.substr(text)) == found.end())
                    found.push_back(line.substr(text));
    return found;
}

/// gmsh 4.8 throws strings or numbers, later versions exceptions; its log has the reason.
template <class Action>
void guarded(const std::filesystem::path& file, Action&& action)
{
    std::string thrown;
    try
    {
        action();
    }
    catch (const InputError&)
    {
        throw;
    }
    catch (const std::string& message)
    {
        thrown = message;
    }
    catch (const std::exception& error)
    {
        thrown = error.what();
    }
    catch (...)
    {
        thrown = "gmsh stopped without a reason";
    }
    std::vector<std::string> errors = logged("Error");
    if (errors.empty() && !thrown.empty())
        errors.push_back(thrown);
    if (errors.size() > 3)
        errors.resize(3);
    if (errors.empty())
        return;
    int line = 0; // gmsh begins with it: 'column.geo', line 2: ...
    const std::string place = fmt::format("'{}', line ", file.string());
    if (errors[0].rfind(place, 0) == 0)
        if (const std::size_t colon = errors[0].find(": "); colon != std::string::npos)
        {
            line = std::atoi(errors[0].c_str() + place.size());
            errors[0].erase(0, colon + 2);
        }
    throw InputError({file.string(), line}, "gmsh: " + joinWords(errors, "; "));
}

class Reader
{
  public:
    Reader(const std::filesystem::path& file, int dim, const std::string& ending)
        : cad_(ending != ".stl" && ending != ".msh"), labelled_(ending == ".step" || ending == ".stp"),
          closedSurface_(ending == ".stl" && dim == 3), isScript_(ending == ".geo")
    {
        mesh_.file = file;
        mesh_.dim = dim;
    }

    GmshMesh run(double scale)
    {
        Session session(mesh_.dim);
        guarded(mesh_.file, [&] { open(); });
        guarded(mesh_.file, [&] {
            collectRegions();
            collectBoundaries();
        });
        for (const std::string& warning : logged("Warning"))
            mesh_.notes.push_back("gmsh warns: " + warning);
        flatten(mesh_);
        for (Vector3& p : mesh_.points)
            for (double& x : p)
                x *= scale;
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw InputError({mesh_.file.string(), 0}, what); }

    void open()
    {
        if (labelled_)
            readUnit();
        if (isScript_ && !endsWithNewline(mesh_.file))
            fail("its last line has no line end, so gmsh would not read it; add one");
        guarded(mesh_.file, [&] { gmsh::open(mesh_.file.string()); });
        gmsh::vectorpair entities;
        model::getEntities(entities, mesh_.dim);
        if (entities.empty() && !closedSurface_)
            fail(fmt::format(
                "found a geometry of dimension {}, but gridDict asks for {}; {}", model::getDimension(), mesh_.dim,
                mesh_.dim == 2 ? "draw plane surfaces (Plane Surface, Physical Surface)"
                               : "draw volumes (Volume, Physical Volume) or give the closed surface as .stl"));
        if (cad_)
        {
            gmsh::option::setNumber("Mesh.ElementOrder", 1);
            refineCurvedSurfaces();
            model::mesh::generate(mesh_.dim - 1);
        }
        std::vector<std::size_t> tags;
        std::vector<double> coordinates, parameters;
        model::mesh::getNodes(tags, coordinates, parameters);
        for (std::size_t i = 0; i < tags.size(); ++i)
        {
            index_.emplace(tags[i], int(i));
            mesh_.points.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
        }
    }

    /// Curved surfaces of OpenCASCADE's kernel; in gmsh's own kernel the option takes minutes, and edges do.
    void refineCurvedSurfaces() const
    {
        double chords = 0;
        gmsh::vectorpair solids;
        model::occ::getEntities(solids, 3);
        gmsh::option::getNumber("Mesh.MeshSizeFromCurvature", chords);
        if (mesh_.dim == 3 && !solids.empty() && chords == 0)
            gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 130);
    }

    void readUnit()
    {
        const std::string unit = stepUnit(mesh_.file);
        gmsh::option::setString("Geometry.OCCTargetUnit", unit == "METRE" ? "M" : "MM");
        if (unit != "METRE")
            mesh_.notes.push_back(fmt::format(
                "the file's unit of length is {}; its coordinates{} are taken as metres (`scale` "
                "multiplies them)",
                unit.empty() ? "not given" : unit, unit == "MILLI METRE" || unit.empty() ? "" : " in millimetres"));
    }

    struct Group
    {
        std::string name;
        std::vector<int> entities;
    };

    /// Groups of one dimension in the file's order; equal names are one group.
    std::vector<Group> groups(int dim, const std::string& fallbackName) const
    {
        std::vector<Group> found;
        const auto add = [&](const std::string& name, const std::vector<int>& tags) {
            auto same = std::find_if(found.begin(), found.end(), [&](const Group& g) { return g.name == name; });
            if (same == found.end())
                same = found.insert(found.end(), {name, {}});
            for (const int tag : tags)
                if (std::find(same->entities.begin(), same->entities.end(), tag) == same->entities.end())
                    same->entities.push_back(tag);
        };
        gmsh::vectorpair physical, entities;
        model::getPhysicalGroups(physical, dim);
        for (const auto& [d, tag] : physical)
        {
            std::string name;
            std::vector<int> tags;
            model::getPhysicalName(d, tag, name);
            model::getEntitiesForPhysicalGroup(d, tag, tags);
            add(name.empty() ? fallbackName + std::to_string(tag) : name, tags);
        }
        model::getEntities(entities, dim);
        for (const auto& [d, tag] : entities)
            if (const std::string label = labelled_ ? labelOf(d, tag) : ""; !label.empty())
                add(label, {tag});
        return found;
    }

    /// Last part of a CAD label; OpenCASCADE's own inventions are none.
    static std::string labelOf(int dim, int tag)
    {
        std::string label;
        model::getEntityName(dim, tag, label);
        label = label.substr(label.rfind('/') + 1);
        return label.rfind("Open CASCADE", 0) == 0 ? "" : label;
    }

    void collectRegions()
    {
        std::vector<Group> found = closedSurface_ ? std::vector<Group>{} : groups(mesh_.dim, "region");
        gmsh::vectorpair entities;
        model::getEntities(entities, closedSurface_ ? 2 : mesh_.dim);
        if (found.empty())
        {
            found.push_back({mesh_.file.stem().string(), {}});
            for (const auto& [d, tag] : entities)
                found[0].entities.push_back(tag);
            mesh_.notes.push_back(
                fmt::format("no physical group of dimension {}: everything is one region, named after the file: {}",
                            mesh_.dim, found[0].name));
        }
        std::size_t grouped = 0;
        for (const auto& [d, tag] : entities)
            grouped += std::any_of(found.begin(), found.end(), [t = tag](const Group& g) {
                return std::find(g.entities.begin(), g.entities.end(), t) != g.entities.end();
            });
        if (grouped < entities.size())
            mesh_.notes.push_back(fmt::format("{} of {} {} belong to no physical group and are left out",
                                              entities.size() - grouped, entities.size(),
                                              mesh_.dim == 2 ? "surfaces" : "volumes"));
        for (const Group& group : found)
        {
            RawRegion region{group.name, {}, cad_ && mesh_.dim == 2};
            if (closedSurface_)
                region.parts.emplace_back();
            for (const int tag : group.entities)
                if (closedSurface_)
                    append(region.parts.back(), elementsOf(2, tag));
                else
                    region.parts.push_back(cad_ ? cadSurface(tag) : meshSurface(tag));
            if (oddElements(region.parts).empty())
                fail(fmt::format("region '{}' has no elements", group.name));
            mesh_.regions.push_back(std::move(region));
        }
    }

    void collectBoundaries()
    {
        if (closedSurface_)
            return;
        for (const Group& group : groups(mesh_.dim - 1, "boundary"))
        {
            RawBoundary boundary{group.name, {}};
            for (const int tag : group.entities)
                append(boundary.elements, elementsOf(mesh_.dim - 1, tag));
            mesh_.boundaries.push_back(std::move(boundary));
        }
    }

    static void append(std::vector<Simplex>& to, const std::vector<Simplex>& from)
    {
        to.insert(to.end(), from.begin(), from.end());
    }

    /// Elements on the curves or surfaces around one CAD surface or volume.
    std::vector<Simplex> cadSurface(int tag)
    {
        gmsh::vectorpair around;
        model::getBoundary({{mesh_.dim, tag}}, around, false, false);
        std::vector<Simplex> all;
        for (const auto& [d, t] : around)
            append(all, elementsOf(d, std::abs(t)));
        return all;
    }

    /// Sides of the elements of a mesh entity that belong to one element only.
    std::vector<Simplex> meshSurface(int tag)
    {
        std::vector<std::vector<Simplex>> sides(1);
        forEachElement(mesh_.dim, tag, [&](int type, const std::vector<int>& n) { addSides(type, n, sides[0]); });
        return oddElements(sides);
    }

    /// Segments (dim 1) or triangles (dim 2) of one entity.
    const std::vector<Simplex>& elementsOf(int dim, int tag)
    {
        auto& known = elements_[{dim, tag}];
        if (!known.empty())
            return known;
        forEachElement(dim, tag, [&](int, const std::vector<int>& n) {
            if (dim == 1)
                known.push_back({n[0], n[1], -1});
            else
                addFace(n, known);
        });
        if (dim == 1 && cad_)
            straighten(tag, known);
        return known;
    }

    /// A curve that gmsh calls a line and whose nodes agree is one segment between its ends.
    void straighten(int tag, std::vector<Simplex>& segments) const
    {
        std::string type;
        model::getType(1, tag, type);
        std::map<int, int> uses;
        for (const Simplex& s : segments)
            ++uses[s[0]], ++uses[s[1]];
        std::vector<int> ends;
        for (const auto& [node, count] : uses)
            if (count == 1)
                ends.push_back(node);
        if (type != "Line" || ends.size() != 2)
            return;
        const Vector3 &a = mesh_.points[std::size_t(ends[0])], &b = mesh_.points[std::size_t(ends[1])];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        for (const auto& [node, count] : uses)
        {
            const Vector3& p = mesh_.points[std::size_t(node)];
            const double way =
                std::hypot(p[0] - a[0], p[1] - a[1], p[2] - a[2]) + std::hypot(p[0] - b[0], p[1] - b[1], p[2] - b[2]);
            if (way > (1 + 1e-9) * length)
                return;
        }
        segments = {{segments[0][0] == ends[1] ? ends[1] : ends[0], segments[0][0] == ends[1] ? ends[0] : ends[1], -1}};
    }

    template <class Visit>
    void forEachElement(int dim, int tag, Visit&& visit)
    {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> tags, nodes;
        model::mesh::getElements(types, tags, nodes, dim, tag);
        for (std::size_t t = 0; t < types.size(); ++t)
        {
            std::string name;
            int elementDim = 0, order = 0, count = 0, primary = 0;
            std::vector<double> local;
            model::mesh::getElementProperties(types[t], name, elementDim, order, count, local, primary);
            if (order > 1 || types[t] > 7)
                fail(
                    fmt::format("elements of type '{}' are not read; write the mesh with Mesh.ElementOrder = 1", name));
            std::vector<int> n(static_cast<std::size_t>(count));
            for (std::size_t e = 0; e < tags[t].size(); ++e)
            {
                for (std::size_t k = 0; k < n.size(); ++k)
                    n[k] = index_.at(nodes[t][e * n.size() + k]);
                visit(types[t], n);
            }
        }
    }

    GmshMesh mesh_;
    bool cad_, labelled_, closedSurface_, isScript_;
    std::unordered_map<std::size_t, int> index_;
    std::map<std::pair<int, int>, std::vector<Simplex>> elements_;
};
} // namespace

GmshMesh readGmshHere(const std::filesystem::path& file, int dim, double scale)
{
    return Reader(file, dim, checkedEnding(file)).run(scale);
}
} // namespace mpm::geometry
