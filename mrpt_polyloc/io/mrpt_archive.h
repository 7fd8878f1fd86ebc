#pragma once

#include <mrpt_polyloc/io/GzInputStream.h>

#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <exception>
#include <string>

namespace mrpt_polyloc {

/// The next object of a stream of MRPT's serialised objects; null where a null was stored.
///
/// \param index its number in the file from 0, to name the place
/// \throws FormatError if there is no further object, the file ends inside it, its class is not
/// known, or its content is damaged.
mrpt::serialization::CSerializable::Ptr readObject(GzInputStream& stream, std::size_t index);

/// The message of an exception of MRPT's without source location and backtrace.
std::string plainMessage(const std::exception& error);

}  // namespace mrpt_polyloc
