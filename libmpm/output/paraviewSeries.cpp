#include "output/paraviewSeries.hpp"

#include "output/replaceFile.hpp"
#include "output/stateFile.hpp"
#include "output/visualisation.hpp"

#include <fmt/format.h>
#include <iterator>

namespace mpm::output
{
namespace
{
enum class Picture
{
    points,
    domains
};

std::string escaped(const std::string& text)
{
    std::string out;
    for (char c : text)
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return out;
}

/// The XML of one time.
class GridText
{
  public:
    GridText(const std::string& timeName, const StateSummary& summary)
        : file_(escaped(timeName) + "/" + stateFileName), summary_(summary), n_(summary.particles)
    {}

    std::string text(Picture picture)
    {
        add("<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"{:.17g}\"/>\n", summary_.time);
        picture == Picture::points ? points() : domains();
        const std::string centre = picture == Picture::points ? "Node" : "Cell";
        for (int k = 0; k < stressComponents(summary_.dim); ++k)
            component(centre, stressComponentName(k), "");
        attribute(centre, "velocity", "Vector", item(fmt::format("{} 3", n_), "Float", 4, "/visualisation/velocity"));
        attribute(centre, "mass", "Scalar", item(std::to_string(n_), "Float", 8, "/particles/mass"));
        attribute(centre, "id", "Scalar", item(std::to_string(n_), "Int", 8, "/particles/id"));
        for (const auto& field : summary_.derived)
            for (const auto& name : derivedComponentNames(field.name, field.components))
                component(centre, name, "derived/");
        add("</Grid>\n");
        return std::move(text_);
    }

  private:
    template <class... Arguments>
    void add(fmt::format_string<Arguments...> format, Arguments&&... arguments)
    {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    }

    std::string item(const std::string& dimensions, const char* type, int precision, const std::string& dataset) const
    {
        return fmt::format(
            "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}</DataItem>",
            dimensions, type, precision, file_, escaped(dataset));
    }

    void points()
    {
        add("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">\n{}\n</Topology>\n",
            n_, item(std::to_string(n_), "Int", 4, "/visualisation/connectivity"));
        add("<Geometry GeometryType=\"XYZ\">\n{}\n</Geometry>\n",
            item(fmt::format("{} 3", n_), "Float", 4, "/visualisation/points"));
    }

    void domains()
    {
        const int corners = summary_.dim == 2 ? 4 : 8;
        add("<Topology TopologyType=\"{}\" NumberOfElements=\"{}\">\n{}\n</Topology>\n",
            summary_.dim == 2 ? "Quadrilateral" : "Hexahedron", n_,
            item(fmt::format("{} {}", n_, corners), "Int", 4, "/visualisation/cornerConnectivity"));
        add("<Geometry GeometryType=\"XYZ\">\n{}\n</Geometry>\n",
            item(fmt::format("{} 3", n_ * corners), "Float", 4, "/visualisation/corners"));
    }

    void attribute(const std::string& centre, const std::string& name, const char* type, const std::string& data)
    {
        add("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n{}\n</Attribute>\n", escaped(name), type,
            centre, data);
    }

    void component(const std::string& centre, const std::string& name, const std::string& group)
    {
        attribute(centre, name, "Scalar", item(std::to_string(n_), "Float", 4, "/visualisation/" + group + name));
    }

    std::string file_;
    const StateSummary& summary_;
    Index n_;
    std::string text_;
};

void writeSeries(const std::filesystem::path& file, Picture picture, const std::vector<std::string>& names,
                 const std::vector<StateSummary>& summaries)
{
    std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
                       "<Grid Name=\"series\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (std::size_t i = 0; i < names.size(); ++i)
        if (summaries[i].particles > 0)
            text += GridText(names[i], summaries[i]).text(picture);
    text += "</Grid>\n</Domain>\n</Xdmf>\n";
    replaceText(file, text);
}
} // namespace

ParaviewSeries::ParaviewSeries(std::filesystem::path caseFolder, std::string caseName)
    : folder_(std::move(caseFolder)), name_(std::move(caseName))
{}

const StateSummary& ParaviewSeries::summary(const std::string& timeName)
{
    const auto file = folder_ / timeName / stateFileName;
    std::error_code error;
    const auto changed = std::filesystem::last_write_time(file, error);
    const auto found = known_.find(timeName);
    if (!error && found != known_.end() && found->second.changed == changed)
        return found->second.summary;
    return (known_[timeName] = {changed, readSummary(file)}).summary;
}

void ParaviewSeries::write(const std::vector<std::string>& timeNames)
{
    std::vector<StateSummary> summaries;
    for (const auto& name : timeNames)
        summaries.push_back(summary(name));
    writeSeries(folder_ / (name_ + ".xdmf"), Picture::points, timeNames, summaries);
    writeSeries(folder_ / (name_ + ".domains.xdmf"), Picture::domains, timeNames, summaries);
}

void writeParaviewSeries(const std::filesystem::path& caseFolder, const std::string& caseName,
                         const std::vector<std::string>& timeNames)
{
    ParaviewSeries(caseFolder, caseName).write(timeNames);
}
} // namespace mpm::output
