// Boost.JSON, compiled once for all who use it.
#include <boost/json/src.hpp>
