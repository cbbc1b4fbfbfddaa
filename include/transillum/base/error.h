/// Typed errors. A message is one line that names where (file, line, object, face or option), what
/// was found and what is accepted. The library throws; only the program's `main` prints and exits.
#pragma once

#include <stdexcept>
#include <string>

namespace transillum {

/// Base of everything the library throws on purpose.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An option or argument outside what is accepted (exit code 2).
class UsageError : public Error {
public:
    using Error::Error;
};

/// A scene, mesh, image or solution that cannot be used (exit code 3).
/// `where` is a file and, where known, a line, object or face: "room.obj:12".
class InputError : public Error {
public:
    InputError(const std::string& where, const std::string& what) : Error(where + ": " + what) {}
};

/// A file that cannot be read or written (exit code 4).
class IoError : public Error {
public:
    IoError(const std::string& where, const std::string& what) : Error(where + ": " + what) {}
};

}  // namespace transillum
