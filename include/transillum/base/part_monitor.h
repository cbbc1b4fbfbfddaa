/// Work that is done several times over, as seen from outside.
#pragma once

#include <transillum/base/monitor.h>

#include <string>
#include <utility>

namespace transillum {

/// Names the part in its progress. Warnings pass; notes are dropped, as they would be the same for
/// each part. Keeps a reference.
class PartMonitor : public Monitor {
public:
    PartMonitor(Monitor& whole, std::string part) : whole_(whole), part_(std::move(part)) {}
    void progress(const Progress& p) override {
        const std::string phase = part_ + ": " + std::string(p.phase);
        Progress named = p;
        named.phase = phase;
        whole_.progress(named);
    }
    void warn(const std::string& message) override { whole_.warn(message); }
    [[nodiscard]] bool stop_requested() const override { return whole_.stop_requested(); }

private:
    Monitor& whole_;
    std::string part_;
};

}  // namespace transillum
