#pragma once

#include <mpi.h>

#include <graze/cluster/transport.hpp>
#include <graze/export.hpp>
#include <memory>

namespace graze::cluster {

/// @addtogroup cluster
/// @{

/// Returns a transport between the processes of an MPI communicator. Every process of it calls this, after
/// MPI_Init() and before MPI_Finalize(), and destroys what it gets before MPI_Finalize(). The transport uses
/// a duplicate of the communicator. One thread at a time calls MPI, as MPI_THREAD_SERIALIZED allows.
///
/// Transport::fail() writes its sentence to standard error and ends all processes of the communicator by
/// MPI_Abort(). A process that is killed ends the others too, as MPI's launcher does.
///
/// Throws Error if the communicator is null, or if MPI reports an error.
[[nodiscard]] GRAZE_API std::shared_ptr<Transport> mpi_transport(MPI_Comm communicator);

/// @}

}  // namespace graze::cluster
