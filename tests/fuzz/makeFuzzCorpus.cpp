// Writes the binary part of the corpus, when a format has changed:  makeFuzzCorpus tests/fuzz/corpus
#include "geometry/meshBytes.hpp"
#include "output/stateFile.hpp"
#include "support/sampleState.hpp"

#include <fstream>

using namespace mpm;

int main(int count, char** arguments)
{
    if (count != 2)
        return 1;
    const std::filesystem::path corpus = arguments[1];
    for (const auto& [dim, particles] : {std::pair(2, 0), std::pair(2, 3), std::pair(3, 2)})
    {
        const auto name = "valid" + std::to_string(dim) + "D" + std::to_string(particles);
        output::writeState(corpus / "state" / "folder", tests::sampleState(dim, particles));
        std::filesystem::rename(corpus / "state" / "folder" / "state.h5", corpus / "state" / name);
        std::filesystem::remove(corpus / "state" / "folder");
    }
    for (const int dim : {2, 3})
        for (const char* name : {"plate.geo", "box.geo"})
        {
            const auto file = corpus / "geometry" / name;
            if ((dim == 2) != (file.stem() == "plate"))
                continue;
            std::ofstream out(corpus / "mesh" / file.stem(), std::ios::binary);
            out << dim << geometry::meshBytes(geometry::readGmsh(file, dim));
        }
    return 0;
}
