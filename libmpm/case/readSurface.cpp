#include "case/readSurface.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <sstream>
#include <unordered_map>

namespace mpm::cases
{
namespace
{
using Element = nodal::RigidSurface::Element;

/// Blank-separated words with their lines.
class Words
{
  public:
    Words(std::string file, const std::string& text) : file_(std::move(file)), in_(text) {}

    bool next(std::string& word)
    {
        while (!(line_ >> word))
        {
            std::string text;
            if (!std::getline(in_, text))
                return false;
            line_ = std::istringstream(text);
            ++number_;
        }
        return true;
    }
    std::string word(const char* what)
    {
        std::string out;
        if (!next(out))
            fail(fmt::format("found the end of the file, allowed is {}", what));
        return out;
    }
    double number(const char* what)
    {
        const std::string text = word(what);
        char* end = nullptr;
        const double out = std::strtod(text.c_str(), &end);
        if (end != text.c_str() + text.size())
            fail(fmt::format("found '{}', allowed is {}", text.substr(0, 40), what));
        return out;
    }
    Index count(const char* what)
    {
        const double out = number(what);
        if (!(out >= 0 && out <= 1e9 && out == double(Index(out))))
            fail(fmt::format("found {:g}, allowed is {}", out, what));
        return Index(out);
    }
    [[noreturn]] void fail(const std::string& what) const { throw InputError({file_, number_}, what); }

  private:
    std::string file_;
    std::istringstream in_, line_;
    int number_ = 0;
};

using Raw = SurfaceElements;

Raw readAsciiStl(Words& words)
{
    Raw out;
    std::string word;
    while (words.next(word))
        if (word == "vertex")
        {
            Vector3 x{};
            for (double& component : x)
                component = words.number("a coordinate");
            out.points.push_back(x);
        }
    if (out.points.size() % 3 != 0)
        words.fail(fmt::format("found {} vertices, allowed are three a facet", out.points.size()));
    for (Index n = 0; n + 2 < Index(out.points.size()); n += 3)
        out.elements.push_back({n, n + 1, n + 2});
    return out;
}

Raw readBinaryStl(const std::string& bytes, std::uint32_t count)
{
    Raw out;
    for (std::size_t n = 0; n < count; ++n)
    {
        float corner[9];
        std::memcpy(corner, bytes.data() + 84 + 50 * n + 12, sizeof corner);
        for (int k = 0; k < 3; ++k)
            out.points.push_back({corner[3 * k], corner[3 * k + 1], corner[3 * k + 2]});
        out.elements.push_back({Index(3 * n), Index(3 * n + 1), Index(3 * n + 2)});
    }
    return out;
}

/// Sections Nodes and Elements; elements of the wanted kind are kept.
class MeshFile
{
  public:
    MeshFile(Words& words, int dim) : words_(words), wanted_(dim == 2 ? 1 : 2) {}

    Raw read()
    {
        std::string word;
        while (words_.next(word))
            if (word == "$MeshFormat")
            {
                version_ = words_.number("a version");
                if (words_.count("0, the mark of an ASCII file") != 0)
                    words_.fail("found a binary mesh, allowed is ASCII (gmsh -format msh41)");
                if (version_ != 2.2 && version_ != 4.1)
                    words_.fail(fmt::format("found format {:g}, allowed are 2.2 and 4.1", version_));
            }
            else if (word == "$Nodes")
                version_ == 2.2 ? nodes2() : nodes4();
            else if (word == "$Elements")
                version_ == 2.2 ? elements2() : elements4();
        return std::move(raw_);
    }

  private:
    static int cornersOf(Index type) { return type == 1 ? 2 : type == 2 ? 3 : type == 3 || type == 4 ? 4 : 1; }
    void point(Index tag)
    {
        Vector3 x{};
        for (double& component : x)
            component = words_.number("a coordinate");
        names_[tag] = Index(raw_.points.size());
        raw_.points.push_back(x);
    }
    void nodes2()
    {
        for (Index n = words_.count("a number of nodes"); n > 0; --n)
            point(words_.count("a node's number"));
    }
    void nodes4()
    {
        const Index blocks = words_.count("a number of blocks");
        for (int k = 0; k < 3; ++k)
            words_.count("a count");
        for (Index b = 0; b < blocks; ++b)
        {
            for (int k = 0; k < 2; ++k)
                words_.number("a tag");
            if (words_.count("0") != 0)
                words_.fail("found parametric nodes, allowed are plain ones");
            std::vector<Index> tags(std::size_t(words_.count("a number of nodes")));
            for (auto& tag : tags)
                tag = words_.count("a node's number");
            for (const Index tag : tags)
                point(tag);
        }
    }
    void element(Index type)
    {
        if (type != 1 && type != 2 && type != 3 && type != 4 && type != 15)
            words_.fail(
                fmt::format("found elements of type {}, allowed are segments and triangles of first order", type));
        Element e{};
        for (int k = 0; k < cornersOf(type); ++k)
        {
            const auto found = names_.find(words_.count("a node's number"));
            if (found == names_.end())
                words_.fail("found an element of a node that is not there");
            if (k < 3)
                e[std::size_t(k)] = found->second;
        }
        if (type == wanted_)
            raw_.elements.push_back(e);
    }
    void elements2()
    {
        for (Index n = words_.count("a number of elements"); n > 0; --n)
        {
            words_.count("an element's number");
            const Index type = words_.count("a type");
            for (Index tags = words_.count("a number of tags"); tags > 0; --tags)
                words_.number("a tag");
            element(type);
        }
    }
    void elements4()
    {
        const Index blocks = words_.count("a number of blocks");
        for (int k = 0; k < 3; ++k)
            words_.count("a count");
        for (Index b = 0; b < blocks; ++b)
        {
            for (int k = 0; k < 2; ++k)
                words_.number("a tag");
            const Index type = words_.count("a type");
            for (Index n = words_.count("a number of elements"); n > 0; --n)
            {
                words_.count("an element's number");
                element(type);
            }
        }
    }

    Words& words_;
    Index wanted_;
    double version_ = 0;
    std::unordered_map<Index, Index> names_;
    Raw raw_;
};

/// gmsh's curves and surfaces face as they were written: all are turned like their neighbours.
void turnAlike(std::vector<Element>& elements, int dim)
{
    const auto corners = std::size_t(dim);
    // what two elements share: a point in 2D, an edge in 3D
    std::map<std::pair<Index, Index>, std::vector<std::size_t>> shared;
    const auto side = [&](const Element& e, std::size_t k) {
        return dim == 2 ? std::pair(e[k], Index(0))
                        : std::pair(std::min(e[k], e[(k + 1) % 3]), std::max(e[k], e[(k + 1) % 3]));
    };
    const auto first = [&](const Element& e, const std::pair<Index, Index>& s) { // which way e meets it
        for (std::size_t k = 0; k < corners; ++k)
            if (side(e, k) == s)
                return dim == 2 ? k == 0 : e[k] == s.first;
        return false;
    };
    for (std::size_t n = 0; n < elements.size(); ++n)
        for (std::size_t k = 0; k < corners; ++k)
            shared[side(elements[n], k)].push_back(n);
    std::vector<bool> done(elements.size());
    for (std::size_t start = 0; start < elements.size(); ++start)
    {
        std::vector<std::size_t> stack;
        if (!done[start])
            stack.push_back(start);
        done[start] = true;
        while (!stack.empty())
        {
            const std::size_t n = stack.back();
            stack.pop_back();
            for (std::size_t k = 0; k < corners; ++k)
            {
                const auto s = side(elements[n], k);
                for (const std::size_t other : shared[s])
                    if (!done[other])
                    {
                        if (first(elements[other], s) == first(elements[n], s))
                            std::swap(elements[other][0], elements[other][1]);
                        done[other] = true;
                        stack.push_back(other);
                    }
            }
        }
    }
}
} // namespace

SurfaceElements readSurfaceElements(const std::filesystem::path& file, int dim, double scale)
{
    const Location where{file.string(), 0};
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (ending == ".geo")
        throw InputError(where, fmt::format("found a script of gmsh, allowed is a mesh: gmsh -{} {} makes {}.msh",
                                            dim - 1, file.filename().string(), file.stem().string()));
    if (ending != ".msh" && !(ending == ".stl" && dim == 3))
        throw InputError(
            where, fmt::format("found the ending '{}', allowed {}", ending,
                               dim == 2 ? "is .msh (or points ((0 0) ...) in the dictionary)" : "are .stl and .msh"));
    std::ifstream in(file, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    if (!in)
        throw InputError(where, "cannot be read");
    const std::string bytes = content.str();
    if (bytes.size() > (std::size_t(256) << 20))
        throw InputError(where, "found more than 256 MB, too much for a surface");
    std::uint32_t count = 0;
    if (bytes.size() >= 84)
        std::memcpy(&count, bytes.data() + 80, 4);
    Raw raw;
    if (ending == ".stl" && bytes.size() >= 84 && bytes.size() == 84 + 50 * std::size_t(count))
        raw = readBinaryStl(bytes, count);
    else
    {
        Words words(file.string(), bytes);
        if (ending == ".stl")
            raw = readAsciiStl(words);
        else
        {
            raw = MeshFile(words, dim).read();
            turnAlike(raw.elements, dim);
        }
    }
    if (raw.elements.empty())
        throw InputError(where, fmt::format("found no {}", dim == 2 ? "segments" : "triangles"));
    for (auto& x : raw.points)
        for (std::size_t a = 0; a < 3; ++a)
            x[a] = dim == 2 && a == 2 ? 0 : x[a] * scale;
    // points of other elements (of a volume, a centre) do not belong to the surface
    std::vector<Index> name(raw.points.size(), -1);
    for (const auto& e : raw.elements)
        for (std::size_t k = 0; k < std::size_t(dim); ++k)
            name[std::size_t(e[k])] = 0;
    std::vector<Vector3> used;
    for (std::size_t n = 0; n < name.size(); ++n)
        if (name[n] == 0)
        {
            name[n] = Index(used.size());
            used.push_back(raw.points[n]);
        }
    for (auto& e : raw.elements)
        for (std::size_t k = 0; k < std::size_t(dim); ++k)
            e[k] = name[std::size_t(e[k])];
    if (dim == 2)
        for (auto& e : raw.elements)
            e[2] = 0;
    return {std::move(used), std::move(raw.elements)};
}

nodal::RigidSurface readSurface(const std::filesystem::path& file, int dim, double scale)
{
    auto found = readSurfaceElements(file, dim, scale);
    return nodal::RigidSurface(dim, std::move(found.points), std::move(found.elements), {file.string()});
}
} // namespace mpm::cases
