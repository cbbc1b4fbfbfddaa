// The short matrix of conditions; `stress` prints it as a table.
#include "physics/stability/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>

namespace transillum::stability {

void PrintTo(const Condition& condition, std::ostream* out) {
    *out << condition.name;
}

namespace {

std::vector<Condition> short_conditions() {
    std::vector<Condition> all = all_conditions();
    std::erase_if(all, [](const Condition& c) { return c.is_long; });
    return all;
}

class Stability : public testing::TestWithParam<Condition> {};

TEST_P(Stability, Holds) {
    const Row row = measure(GetParam(), {}, Workers(2));
    for (const std::string& fault : row.faults) ADD_FAILURE() << fault;
}

INSTANTIATE_TEST_SUITE_P(Short, Stability, testing::ValuesIn(short_conditions()),
                         [](const auto& info) {
                             std::string name = info.param.name;
                             std::ranges::replace_if(
                                 name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                             return std::to_string(info.index) + '_' + name;
                         });

}  // namespace

}  // namespace transillum::stability
