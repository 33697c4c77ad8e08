#include "fmi/fmi3Functions.h"
#include "soilSide.hpp"

#include <dlfcn.h>
#include <fstream>
#include <iterator>
#include <regex>
#include <vector>

namespace springWall
{
namespace
{
std::string contents(const std::filesystem::path& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// modelDescription.xml of an FMU: just what is asked of it here.
class Description
{
  public:
    explicit Description(const std::filesystem::path& unpacked) : text_(contents(unpacked / "modelDescription.xml")) {}
    std::string attribute(const std::string& name) const { return find(name + "=\"([^\"]*)\"", name); }
    fmi3ValueReference reference(const std::string& variable) const
    {
        std::string escaped;
        for (char c : variable)
            escaped += c == '.' ? std::string("\\.") : std::string(1, c);
        const std::string element = find("<Float64([^>]*\\bname=\"" + escaped + "\"[^>]*)>", variable);
        std::smatch found;
        std::regex_search(element, found, std::regex("valueReference=\"([0-9]+)\""));
        return fmi3ValueReference(std::stoul(found[1].str()));
    }

  private:
    std::string find(const std::string& pattern, const std::string& what) const
    {
        std::smatch found;
        if (!std::regex_search(text_, found, std::regex(pattern)))
            throw SoilLost("modelDescription.xml: found no " + what);
        return found[1].str();
    }
    std::string text_;
};

class ByFmu : public SoilSide
{
  public:
    explicit ByFmu(const std::filesystem::path& unpacked) : description_(unpacked)
    {
        const auto library = std::filesystem::absolute(unpacked) / "binaries" / "x86_64-linux" /
                             (description_.attribute("modelIdentifier") + ".so");
        library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library_)
            throw SoilLost(dlerror());
        const auto resources = std::filesystem::absolute(unpacked).string() + "/resources/";
        instance_ = function<decltype(&fmi3InstantiateCoSimulation)>("fmi3InstantiateCoSimulation")(
            "soil", description_.attribute("instantiationToken").c_str(), resources.c_str(), false, true, false, false,
            nullptr, 0, this, note, nullptr);
        if (!instance_)
            fail();
        position_ = description_.reference("wall.position.x");
        force_ = description_.reference("wall.force.x");
        work_ = description_.reference("wall.interfaceWork");
        time_ = description_.reference("time");
        call<decltype(&fmi3EnterInitializationMode)>("fmi3EnterInitializationMode", false, 0., 0., false, 0.);
        call<decltype(&fmi3ExitInitializationMode)>("fmi3ExitInitializationMode");
        double now = 0;
        call<decltype(&fmi3GetFloat64)>("fmi3GetFloat64", &time_, std::size_t(1), &now, std::size_t(1));
        now_ = now;
    }
    ~ByFmu() override
    {
        if (instance_)
            function<decltype(&fmi3FreeInstance)>("fmi3FreeInstance")(instance_);
    }

    double time() override { return now_; }
    void save() override
    {
        call<decltype(&fmi3GetFMUState)>("fmi3GetFMUState", &start_);
        startTime_ = now_;
    }
    void restore() override
    {
        call<decltype(&fmi3SetFMUState)>("fmi3SetFMUState", start_);
        now_ = startTime_;
    }
    SoilWindow advance(double window, double displacement) override
    {
        call<decltype(&fmi3SetFloat64)>("fmi3SetFloat64", &position_, std::size_t(1), &displacement, std::size_t(1));
        bool event = false, end = false, early = false;
        double reached = 0;
        call<decltype(&fmi3DoStep)>("fmi3DoStep", now_, window, start_ == nullptr, &event, &end, &early, &reached);
        now_ = reached;
        const fmi3ValueReference wanted[] = {force_, work_};
        double values[2];
        call<decltype(&fmi3GetFloat64)>("fmi3GetFloat64", wanted, std::size_t(2), values, std::size_t(2));
        return {values[0], values[1]};
    }
    void accept() override
    {
        if (start_)
            call<decltype(&fmi3FreeFMUState)>("fmi3FreeFMUState", &start_);
        start_ = nullptr;
    }
    void finish() override { call<decltype(&fmi3Terminate)>("fmi3Terminate"); }

  private:
    template <class F>
    F function(const char* name)
    {
        void* symbol = dlsym(library_, name);
        if (!symbol)
            throw SoilLost(dlerror());
        return reinterpret_cast<F>(symbol);
    }
    template <class F, class... Arguments>
    void call(const char* name, Arguments... arguments)
    {
        if (function<F>(name)(instance_, arguments...) != fmi3OK)
            fail();
    }
    static void note(fmi3InstanceEnvironment self, fmi3Status status, fmi3String, fmi3String message)
    {
        if (status != fmi3OK)
            static_cast<ByFmu*>(self)->complaint_ = message;
    }
    [[noreturn]] void fail() { throw SoilLost(complaint_.empty() ? "the FMU refused" : complaint_); }

    Description description_;
    void* library_ = nullptr;
    fmi3Instance instance_ = nullptr;
    fmi3ValueReference position_ = 0, force_ = 0, work_ = 0, time_ = 0;
    fmi3FMUState start_ = nullptr;
    double now_ = 0, startTime_ = 0;
    std::string complaint_;
};
} // namespace

std::unique_ptr<SoilSide> soilByFmu(const std::filesystem::path& unpackedFmu)
{
    return std::make_unique<ByFmu>(unpackedFmu);
}
} // namespace springWall
