#pragma once

// What differs between CGAL 5.5 and 6.2, for the few files that include CGAL. CGAL's results of
// several types are boost::variant up to 5.6 and std::variant from 6.0 on: overloads take either,
// so that no version has to be asked for.

#include <boost/variant/get.hpp>
#include <boost/variant/variant.hpp>

#include <variant>

namespace mrpt_polyloc {

/// The value of a variant if it is a T, else null.
template <class T, class... Types>
const T* valueIf(const std::variant<Types...>& variant) {
  return std::get_if<T>(&variant);
}

template <class T, class First, class... Others>
const T* valueIf(const boost::variant<First, Others...>& variant) {
  return boost::get<T>(&variant);
}

}  // namespace mrpt_polyloc
