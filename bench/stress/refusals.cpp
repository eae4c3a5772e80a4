#include "bench/stress/refusals.h"

#include "renderer/base/error.h"

namespace lightsweep {

std::string wrong_answer(Answer due, const std::function<std::string()>& ask) {
    try {
        std::string wrong = ask();
        if (due == Answer::refused && wrong.empty()) wrong = "not refused";
        return wrong;
    } catch (const std::exception& error) {
        const std::string message = error.what();
        const bool refusal = dynamic_cast<const InputError*>(&error) != nullptr ||
                             dynamic_cast<const EnvironmentError*>(&error) != nullptr;
        if (!refusal) return "broke: " + message;
        if (due == Answer::right) return "refused: " + message;
        return message.empty() ? "refused without a word" : std::string();
    }
}

}  // namespace lightsweep
