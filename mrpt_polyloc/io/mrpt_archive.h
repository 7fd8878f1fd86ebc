#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/io/GzInputStream.h>

#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <string>

namespace mrpt_polyloc {

/// The next object of a stream of MRPT's serialised objects; null where a null was stored.
///
/// \param index its number in the file from 0, to name the place
/// \throws FormatError if there is no further object, the file ends inside it, its class is not
/// known, or its content is damaged.
POLYLOC_EXPORT mrpt::serialization::CSerializable::Ptr readObject(GzInputStream& stream,
                                                                  std::size_t index);

/// Reads all objects of a file. One that ends too early is read up to its last whole object, with a
/// note of what is missing.
///
/// \param strict to refuse such a file instead
/// \param take is given each object and its number from 0
/// \throws FormatError as GzInputStream and readObject(), and if no object is whole
POLYLOC_EXPORT void readObjects(
    const std::string& path, bool strict, Notes* notes,
    const std::function<void(const mrpt::serialization::CSerializable::Ptr&, std::size_t)>& take);

/// The message of an exception of MRPT's without source location and backtrace.
POLYLOC_EXPORT std::string plainMessage(const std::exception& error);

}  // namespace mrpt_polyloc
