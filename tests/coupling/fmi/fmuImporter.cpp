// An importer of FMUs as any tool might have one: it knows nothing of libmpm but the C interface, loads the library of
// an unpacked FMU and does what it is told line by line, values as C prints and reads them exactly (%a).
//
//     fmuImporter LIBRARY RESOURCES TOKEN < commands
//
//     A instantiate [quiet]            A enter START [STOP]        A exit           A terminate     A reset     A free
//     | forget A set REFERENCE VALUE...         A get REFERENCE SIZE        A setInt REFERENCE VALUE         A getInt
//     REFERENCE A setText REFERENCE TEXT         A getText REFERENCE         A step FROM LENGTH [keep] A save NAME A
//     restore NAME              A drop NAME A write NAME FILE                A read NAME FILE            A call
//     FUNCTION  (one without further arguments) A,B steps FROM LENGTH            a step of two instances at the same
//     time, in two threads
//
// Answers: `A VERB STATUS VALUES...`; messages of the FMU: `A log STATUS CATEGORY TEXT`.
#include "fmi/fmi3Functions.h"

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace
{
void* library = nullptr;
std::string resources, token;
std::mutex printing;

const char* statusName(int status)
{
    const char* names[] = {"OK", "Warning", "Discard", "Error", "Fatal"};
    return names[status];
}

template <class F>
F function(const std::string& name)
{
    void* found = dlsym(library, name.c_str());
    if (!found)
    {
        std::fprintf(stderr, "no %s\n", name.c_str());
        std::exit(3);
    }
    return reinterpret_cast<F>(found);
}
#define FMU(name) function<decltype(&name)>(#name)

void logMessage(fmi3InstanceEnvironment who, fmi3Status status, fmi3String category, fmi3String message)
{
    const std::lock_guard lock(printing);
    std::printf("%s log %s %s %s\n", static_cast<const char*>(who), statusName(status), category, message);
}

struct Part
{
    std::string name;
    fmi3Instance instance = nullptr;
    std::map<std::string, fmi3FMUState> states;

    void answer(const std::string& verb, int status, const std::string& values = "") const
    {
        const std::lock_guard lock(printing);
        std::printf("%s %s %s%s\n", name.c_str(), verb.c_str(), statusName(status), values.c_str());
        std::fflush(stdout);
    }
    void step(double from, double length, bool keep);
    bool variables(const std::string& verb, std::istringstream& words);
    bool saved(const std::string& verb, std::istringstream& words);
    bool life(const std::string& verb, std::istringstream& words);
};

std::string shown(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, " %a", value);
    return text;
}

double number(std::istringstream& words)
{
    std::string word;
    words >> word;
    return std::strtod(word.c_str(), nullptr);
}

void Part::step(double from, double length, bool keep)
{
    fmi3Boolean events = true, terminate = true, early = true;
    fmi3Float64 reached = -1;
    const fmi3Status status = FMU(fmi3DoStep)(instance, from, length, !keep, &events, &terminate, &early, &reached);
    answer("step", status, shown(reached) + (events || terminate || early ? " flags" : ""));
}

bool Part::variables(const std::string& verb, std::istringstream& words)
{
    if (verb.rfind("set", 0) != 0 && verb.rfind("get", 0) != 0)
        return false;
    fmi3ValueReference reference = 0;
    words >> reference;
    if (verb == "set")
    {
        std::vector<double> values;
        for (std::string word; words >> word;)
            values.push_back(std::strtod(word.c_str(), nullptr));
        answer(verb, FMU(fmi3SetFloat64)(instance, &reference, 1, values.data(), values.size()));
    }
    else if (verb == "get")
    {
        std::vector<double> values(std::size_t(number(words)));
        const auto status = FMU(fmi3GetFloat64)(instance, &reference, 1, values.data(), values.size());
        std::string text;
        for (const double v : values)
            text += shown(v);
        answer(verb, status, text);
    }
    else if (verb == "setInt")
    {
        const auto value = fmi3Int64(number(words));
        answer(verb, FMU(fmi3SetInt64)(instance, &reference, 1, &value, 1));
    }
    else if (verb == "getInt")
    {
        fmi3Int64 value = -1;
        const auto status = FMU(fmi3GetInt64)(instance, &reference, 1, &value, 1);
        answer(verb, status, " " + std::to_string(value));
    }
    else if (verb == "setText")
    {
        std::string text;
        words >> text;
        const fmi3String value = text.c_str();
        answer(verb, FMU(fmi3SetString)(instance, &reference, 1, &value, 1));
    }
    else if (verb == "getText")
    {
        fmi3String value = nullptr;
        const auto status = FMU(fmi3GetString)(instance, &reference, 1, &value, 1);
        answer(verb, status, std::string(" ") + (value ? value : ""));
    }
    else
        return false;
    return true;
}

bool Part::saved(const std::string& verb, std::istringstream& words)
{
    std::string key, file;
    words >> key >> file;
    if (verb == "save")
        answer(verb, FMU(fmi3GetFMUState)(instance, &states[key]));
    else if (verb == "restore")
        answer(verb, FMU(fmi3SetFMUState)(instance, states[key]));
    else if (verb == "drop")
        answer(verb, FMU(fmi3FreeFMUState)(instance, &states[key]));
    else if (verb == "write")
    {
        std::size_t size = 0;
        FMU(fmi3SerializedFMUStateSize)(instance, states[key], &size);
        std::vector<fmi3Byte> bytes(size);
        const auto status = FMU(fmi3SerializeFMUState)(instance, states[key], bytes.data(), size);
        std::ofstream(file, std::ios::binary).write(reinterpret_cast<char*>(bytes.data()), std::streamsize(size));
        answer(verb, status, " " + std::to_string(size));
    }
    else if (verb == "read")
    {
        std::ifstream in(file, std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
        answer(verb, FMU(fmi3DeserializeFMUState)(instance, reinterpret_cast<const fmi3Byte*>(bytes.data()),
                                                  bytes.size(), &states[key]));
    }
    else
        return false;
    return true;
}

bool Part::life(const std::string& verb, std::istringstream& words)
{
    std::string word;
    if (verb == "instantiate")
    {
        words >> word;
        instance =
            FMU(fmi3InstantiateCoSimulation)(name.c_str(), token.c_str(), resources.c_str(), false, word != "quiet",
                                             false, false, nullptr, 0, name.data(), logMessage, nullptr);
        answer(verb, instance ? fmi3OK : fmi3Error);
    }
    else if (verb == "enter")
    {
        const double start = number(words);
        const bool stops = bool(words >> word);
        const double stop = stops ? std::strtod(word.c_str(), nullptr) : 0;
        answer(verb, FMU(fmi3EnterInitializationMode)(instance, false, 0, start, stops, stop));
    }
    else if (verb == "exit")
        answer(verb, FMU(fmi3ExitInitializationMode)(instance));
    else if (verb == "terminate")
        answer(verb, FMU(fmi3Terminate)(instance));
    else if (verb == "reset")
        answer(verb, FMU(fmi3Reset)(instance));
    else if (verb == "call")
    {
        words >> word;
        answer(verb, function<fmi3Status (*)(fmi3Instance)>(word)(instance));
    }
    else if (verb == "forget") // a tool that ends without freeing what it has
    {
        static auto* forgotten = new std::vector<fmi3Instance>; // in reach to the end: no leak of the importer
        forgotten->push_back(std::exchange(instance, nullptr));
        answer(verb, fmi3OK);
    }
    else if (verb == "free")
    {
        FMU(fmi3FreeInstance)(instance);
        instance = nullptr;
        answer(verb, fmi3OK);
    }
    else
        return false;
    return true;
}

std::map<std::string, Part> parts;

Part& part(const std::string& name)
{
    Part& found = parts[name];
    found.name = name;
    return found;
}
} // namespace

int main(int argc, char** argv)
{
    if (argc != 4)
        return 2;
    library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library)
    {
        std::fprintf(stderr, "%s\n", dlerror());
        return 2;
    }
    resources = argv[2];
    token = argv[3];
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    std::string line, who, verb, rest;
    while (std::getline(std::cin, line))
    {
        std::istringstream words(line);
        words >> who >> verb;
        if (verb == "steps")
        {
            const auto comma = who.find(',');
            const double from = number(words), length = number(words);
            Part &one = part(who.substr(0, comma)), &two = part(who.substr(comma + 1));
            std::thread other([&] { two.step(from, length, false); });
            one.step(from, length, false);
            other.join();
            continue;
        }
        if (verb == "step")
        {
            const double from = number(words), length = number(words);
            part(who).step(from, length, bool(words >> rest));
            continue;
        }
        Part& one = part(who);
        if (!one.life(verb, words) && !one.variables(verb, words) && !one.saved(verb, words))
            return 2;
    }
    for (auto& [name, one] : parts)
        FMU(fmi3FreeInstance)(one.instance);
    return 0;
}
