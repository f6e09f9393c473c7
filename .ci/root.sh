# Read by the scripts beside it: a bare Debian 12, made on the spot, of which nothing is left when they end.
# Wants `root`, an empty folder of its own; the mounts live in namespaces and go with them.

# Makes it, with nothing in it but the packages named, from where this machine has its own.
make_root() {
  [ "$(id -u)" -eq 0 ] || { echo "needs root"; exit 1; }
  unshare --mount --propagation private mount -t tmpfs tmpfs "$root"
  if ! command -v mmdebstrap; then
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends mmdebstrap
  fi
  local sources=/etc/apt/sources.list.d/debian.sources
  [ -f "$sources" ] || sources=/etc/apt/sources.list
  apt-config dump | grep '^Acquire::' >"$root.apt"
  chmod 755 "$root"
  mmdebstrap --quiet --variant=minbase --include="$1" --aptopt="$root.apt" bookworm "$root" "$sources"
  cp -r /etc/ssl/certs/. "$root/etc/ssl/certs/"
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
}

# Runs a command in it with a bare environment. The exit code is the command's.
in_root() {
  export root
  unshare --mount --propagation private bash -euc '
    for place in proc sys dev; do mount --rbind "/$place" "$root/$place"; done
    mount -t tmpfs tmpfs "$root/dev/shm"
    exec chroot "$root" env -i HOME=/root CI=true LANG=C.UTF-8 TERM=dumb \
      PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
  ' root "$@" </dev/null
}
