# shellcheck shell=bash
# A bare Debian 12 in a folder, and commands in it as in an unprivileged container. Part of ./dev
# (fresh), which has the functions that are not here.
: "${root:?} ${cache:?}" # the tree's folder and the cache, as ./dev knows them

bare_release=bookworm
bare_source=/srv/gazeloop # where the tree lies in it

# The lines of a sources.list for the bare Debian, from the mirrors that this machine's apt uses.
bare_sources() {
    local part mirror
    for part in '' -updates -security; do
        while read -r mirror; do
            printf 'deb %s %s main\n' "$mirror" "$bare_release$part"
        done < <(mirrors "$part" | awk '!seen[$0]++')
    done
}

# The archive of the bare Debian: made once; then it is taken from the cache.
make_bare_archive() { # make_bare_archive ARCHIVE FOLDER: in FOLDER, which is removed then
    local folder=$2 mirror status=1
    mirror=$(bare_sources | awk -v suite="$bare_release" '$3 == suite { print $2; exit }')
    [[ -n $mirror ]] || die "fresh: apt knows no mirror of this Debian (/etc/apt/sources.list, sources.list.d)"
    install_packages fresh
    mkdir -- "$folder"
    say "making a bare Debian ($bare_release) from $mirror (a minute or two, once)"
    env http_proxy="$(proxy_of http)" https_proxy="$(proxy_of https)" \
        unshare --mount --propagation private \
        debootstrap --variant=minbase --include=git,ca-certificates \
        --keyring=/usr/share/keyrings/debian-archive-keyring.gpg \
        "$bare_release" "$folder" "$mirror" >"$cache/log/debootstrap.log" 2>&1 </dev/null &&
        rm -rf -- "$folder"/var/cache/apt/archives/*.deb "$folder"/var/lib/apt/lists/* &&
        tar -C "$folder" --one-file-system -cf "$1.new" . && mv -fT -- "$1.new" "$1" && status=0
    rm -rf --one-file-system -- "$folder" "$1.new"
    ((status == 0)) || {
        tail -n 20 -- "$cache/log/debootstrap.log" >&2
        die "fresh: no bare Debian could be made; the log is $cache/log/debootstrap.log"
    }
}

# The proxy that apt (and else the environment) has for a kind of address; empty: none.
proxy_of() { # proxy_of http|https
    local variable=$1_proxy proxy=
    eval "$(apt-config shell proxy "Acquire::$1::Proxy")"
    proxy=${proxy:-${!variable:-}}
    [[ $proxy == DIRECT ]] || printf '%s' "$proxy"
}

# What a new machine is given by whoever installs it: where packages come from, how they are
# fetched, whom to trust for that, and the names of the network.
configure_bare() { # configure_bare FOLDER
    local file
    bare_sources >"$1/etc/apt/sources.list"
    # All of the machine's options, by apt's own reading of every format; not its indexes, which are
    # the release's business.
    apt-config dump | sed -nE '/^Acquire::(IndexTargets|Languages|Changelogs|CompressionTypes)/d; /^Acquire::/p' \
        >"$1/etc/apt/apt.conf.d/90machine"
    for file in /etc/resolv.conf /etc/hosts; do
        cp -L -- "$file" "$1$file"
    done
    for file in /usr/local/share/ca-certificates/*.crt; do
        [[ ! -e $file ]] || cp -L -- "$file" "$1/usr/local/share/ca-certificates/"
    done
}

# The committed tree, cloned as a user would clone it.
clone_into_bare() { # clone_into_bare FOLDER
    local changes
    changes=$(git -c safe.directory="$root" -C "$root" status --porcelain)
    [[ -z $changes ]] || say "not part of it, because not committed:"$'\n'"$changes"
    # git asks who owns the source, in a process that knows no -c.
    GIT_CONFIG_GLOBAL=<(printf '[safe]\n directory = *\n') \
        git clone --quiet --no-local -- "$root" "$1$bare_source"
}

# Runs in a mount and process namespace of its own, as the first process there: mounts and processes
# end with it, however it ends, and nothing of the machine can be written.
enter_bare() { # enter_bare FOLDER COMMAND...
    local folder=$1 device
    shift
    # As a container's engine mounts it: the folder is a file system, with a few devices.
    mount --bind -- "$folder" "$folder"
    cd -- "$folder" || return
    mount -t proc -o nosuid,nodev,noexec proc proc
    mount -t sysfs -o ro,nosuid,nodev,noexec sysfs sys
    mount -t tmpfs -o nosuid,mode=755 tmpfs dev
    mkdir dev/pts dev/shm
    for device in null zero full random urandom tty; do
        touch "dev/$device"
        mount --bind "/dev/$device" "dev/$device"
    done
    ln -s /proc/self/fd dev/fd
    ln -s fd/0 dev/stdin
    ln -s fd/1 dev/stdout
    ln -s fd/2 dev/stderr
    mount -t devpts -o newinstance,ptmxmode=0666,mode=620 devpts dev/pts
    ln -s pts/ptmx dev/ptmx
    mount -t tmpfs -o nosuid,nodev,mode=1777 tmpfs dev/shm
    # The capabilities that Docker gives by default, without those for the network.
    exec chroot . setpriv --no-new-privs --inh-caps=-all --bounding-set \
        -all,+chown,+dac_override,+fsetid,+fowner,+mknod,+setgid,+setuid,+setfcap,+setpcap,+sys_chroot,+kill \
        env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        LANG=C.UTF-8 TERM="${TERM:-dumb}" "$@"
}

in_bare() { # in_bare FOLDER COMMAND...
    local status=0
    # In the background, so that the trap of an interrupt is not kept waiting for its end.
    unshare --mount --propagation private --pid --fork --kill-child \
        bash -euc "$(declare -p bare_source); $(declare -f enter_bare); enter_bare \"\$@\"" bash "$@" \
        </dev/null &
    bare_process=$!
    wait "$bare_process" || status=$?
    bare_process=
    return "$status"
}

end_bare() {
    [[ -z ${bare_process:-} ]] || {
        kill -KILL "$bare_process" 2>/dev/null || true # and with it all that it started
        wait "$bare_process" 2>/dev/null || true
    }
    [[ -z ${bare_folder:-} ]] || rm -rf --one-file-system -- "$bare_folder" "$bare_folder.base"
    [[ -z $caller ]] || give_back
}
