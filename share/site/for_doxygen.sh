#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Doxygen's filter of headers: the text behind \file starts a line of its own, as Doxygen takes its
# first word for the name of a file; the name of a group stands in the line of \ingroup. What an
# internal header declares is marked as such.
internal=
case $1 in
  */internal/pcl6d/*) internal='; s/\\ingroup /\\note Internal: shared by the sources of PCL6D, not installed.\n * \\ingroup /g' ;;
esac
exec sed -z -E 's/\\file ([A-Z])/\\file\n * \1/g; s/\\ingroup\n *\* */\\ingroup /g'"$internal" "$1"
