#include "protocol.h"
#include "soilSide.hpp"

#include <chrono>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

namespace springWall
{
namespace
{
class BySocket : public SoilSide
{
  public:
    explicit BySocket(const std::filesystem::path& path)
    {
        sockaddr_un address = {};
        address.sun_family = AF_UNIX;
        if (path.native().size() >= sizeof(address.sun_path))
            throw SoilLost("the path of the socket is too long");
        std::strcpy(address.sun_path, path.c_str());
        for (int tries = 0; tries < 200; ++tries) // the server may still read its case
        {
            socket_ = socket(AF_UNIX, SOCK_STREAM, 0);
            if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0)
                return;
            close(socket_);
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        throw SoilLost("no soilServer at " + path.string() + " within 10 s");
    }
    ~BySocket() override { close(socket_); }

    double time() override { return ask({SOIL_TIME, 0, 0}).time; }
    void save() override { ask({SOIL_SAVE, 0, 0}); }
    void restore() override { ask({SOIL_RESTORE, 0, 0}); }
    SoilWindow advance(double window, double displacement) override
    {
        const soil_answer answer = ask({SOIL_ADVANCE, window, displacement});
        return {answer.force, answer.work};
    }
    void accept() override { ask({SOIL_ACCEPT, 0, 0}); }
    void finish() override { ask({SOIL_FINISH, 0, 0}); }

  private:
    soil_answer ask(const soil_question& question)
    {
        soil_answer answer;
        if (send(socket_, &question, sizeof(question), MSG_NOSIGNAL) != ssize_t(sizeof(question)) ||
            recv(socket_, &answer, sizeof(answer), MSG_WAITALL) != ssize_t(sizeof(answer)))
            throw SoilLost("the soil's process is gone");
        if (answer.status != 0)
            throw SoilLost(answer.text);
        return answer;
    }
    int socket_ = -1;
};
} // namespace

std::unique_ptr<SoilSide> soilBySocket(const std::filesystem::path& socket)
{
    return std::make_unique<BySocket>(socket);
}
} // namespace springWall
