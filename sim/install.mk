# SPDX-License-Identifier: Apache-2.0
# make install: what is for others to use, under PREFIX; make uninstall takes the same files away.
# DESTDIR stands before every path, for packagers.

PREFIX     := /usr/local
BINDIR     := $(PREFIX)/bin
LIBDIR     := $(PREFIX)/lib
INCLUDEDIR := $(PREFIX)/include
DATADIR    := $(PREFIX)/share
HERE       := $(DATADIR)/halfstep
DOCDIR     := $(DATADIR)/doc/halfstep
VERSION    := $(shell sed -n 's/^\#define HS_VERSION "\(.*\)"/\1/p' sim/options.h)

# --- The library ------------------------------------------------------------------------------------
# Its interface: these, and what they include. The other headers of model/ are its own.
PUBLIC := catmull_clark.h cycles.h definitions.def definitions.h error.h golden.h mesh.h mesh_info.h model.h obj.h \
          reference.h shape.h stream.h
# Before 1.0 a new minor version may change what programs were linked against.
SONAME := libhalfstep.so.$(basename $(VERSION))
SHARED := libhalfstep.so.$(VERSION)

$(BUILD)/pic/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -fPIC -c $< -o $@

$(BUILD)/$(SHARED): $(MODEL_OBJ:$(BUILD)/%=$(BUILD)/pic/%)
	$(CC) -shared -Wl,-soname,$(SONAME) -Wl,-z,defs $^ -o $@ -lz -lm

# --- Files that are made for it -----------------------------------------------------------------------
# Of the tree they stay apart: in the installed list of modules no folder stands, for `verilator -F`.
STAGED := $(addprefix $(BUILD)/install/,halfstep.pc files.f halfstep.1 halfstep _halfstep)
$(BUILD)/install/halfstep.pc: sim/halfstep.pc.in sim/install.mk sim/options.h FORCE
	@mkdir -p $(@D)
	@sed -e 's|@VERSION@|$(VERSION)|' -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(LIBDIR:$(PREFIX)/%=$${prefix}/%)|' \
	    -e 's|@INCLUDEDIR@|$(INCLUDEDIR:$(PREFIX)/%=$${prefix}/%)|' -e 's|@RTL@|$(HERE:$(PREFIX)/%=$${prefix}/%)/rtl|' $< >$@
$(BUILD)/install/files.f: rtl/files.f
	@mkdir -p $(@D)
	@sed 's|^rtl/||' $< >$@

# What the program says of itself: manual, and completion for bash and zsh.
$(BUILD)/install/halfstep.1: SAY := man
$(BUILD)/install/halfstep: SAY := completion bash
$(BUILD)/install/_halfstep: SAY := completion zsh
$(addprefix $(BUILD)/install/,halfstep.1 halfstep _halfstep): $(BUILD)/halfstep
	@mkdir -p $(@D)
	@$< $(SAY) >$@.part && mv $@.part $@

# The page of `halfstep report` needs libraries from npm. REPORT_PAGE= leaves it out.
REPORT_PAGE := $(PAGE)/template.html
.PHONY: page
page:
	@test -z "$(REPORT_PAGE)" || test -f "$(REPORT_PAGE)" || $(MAKE) $(REPORT_PAGE) || \
	    echo "note: npm cannot be reached: without the page of halfstep report"

# --- Where all that goes ------------------------------------------------------------------------------
# FOLDER:MODE:FILE..., a folder a word; what is put in is also what is taken away.
DOCS := README.md CITATION.cff LICENSE
INSTALLED := $(BINDIR):755:$(BUILD)/halfstep \
             $(LIBDIR):644:$(BUILD)/libhalfstep.a \
             $(LIBDIR):644:$(BUILD)/$(SHARED) \
             $(LIBDIR)/pkgconfig:644:$(BUILD)/install/halfstep.pc \
             $(addprefix $(INCLUDEDIR)/halfstep:644:model/,$(PUBLIC)) \
             $(addprefix $(HERE)/rtl:644:,$(BUILD)/install/files.f $(wildcard rtl/*.sv)) \
             $(DATADIR)/man/man1:644:$(BUILD)/install/halfstep.1 \
             $(DATADIR)/bash-completion/completions:644:$(BUILD)/install/halfstep \
             $(DATADIR)/zsh/site-functions:644:$(BUILD)/install/_halfstep \
             $(addprefix $(DOCDIR):644:,$(DOCS)) \
             $(addprefix $(DOCDIR)/docs:644:,$(wildcard docs/*.md)) \
             $(foreach folder,pictures figures,$(addprefix $(DOCDIR)/docs/$(folder):644:,$(wildcard docs/$(folder)/*)))
LINKS := $(LIBDIR)/$(SONAME) $(LIBDIR)/libhalfstep.so

installable: $(BUILD)/halfstep $(BUILD)/libhalfstep.a $(BUILD)/$(SHARED) $(STAGED)
.PHONY: install uninstall installable
install: installable page ## program, library, headers, RTL, documents under PREFIX=/usr/local; DESTDIR= before it
	@for each in $(INSTALLED); do \
	    folder=$${each%%:*}; rest=$${each#*:}; \
	    install -D -m $${rest%%:*} -t "$(DESTDIR)$$folder" "$${rest#*:}" || exit 1; done
	@ln -sf $(SHARED) "$(DESTDIR)$(LIBDIR)/$(SONAME)" && ln -sf $(SHARED) "$(DESTDIR)$(LIBDIR)/libhalfstep.so"
	@test ! -f "$(REPORT_PAGE)" || install -D -m 644 "$(REPORT_PAGE)" "$(DESTDIR)$(HERE)/report/template.html"
	@echo "halfstep $(VERSION) is in $(DESTDIR)$(PREFIX)"

# Folders go where nothing else is in them; those that others use as well stay.
uninstall: ## takes away what make install put there; the same PREFIX and DESTDIR
	@for each in $(INSTALLED); do file=$${each##*:}; rm -f "$(DESTDIR)$${each%%:*}/$${file##*/}"; done
	@rm -f $(LINKS:%="$(DESTDIR)%") "$(DESTDIR)$(HERE)/report/template.html"
	@for folder in "$(INCLUDEDIR)/halfstep" "$(HERE)/rtl" "$(HERE)/report" "$(HERE)" "$(DOCDIR)/docs/pictures" \
	    "$(DOCDIR)/docs/figures" "$(DOCDIR)/docs" "$(DOCDIR)"; do \
	    test ! -d "$(DESTDIR)$$folder" || rmdir --ignore-fail-on-non-empty "$(DESTDIR)$$folder"; done
